#pragma once

#include <vibrocontact/reduction/modes.h>

namespace vibrocontact
{
  /// Vectors of the Krylov sequence for so many modes, at most: fewer motions with mass than that cannot be
  /// told apart by it.
  unsigned int krylov_dimension(unsigned int n_wanted);

  /// Solves G M phi = phi / w^2 by the block Krylov-Schur method of Trilinos' Anasazi, the factorised stiffness
  /// at shift 0 as its operator, several columns at a time. A block also sees modes of equal frequency, as many
  /// as it has columns. Adds to `modes` the `n_wanted` lowest elastic modes that it does not have yet, ascending.
  /// @param tolerance of |G M phi - mu phi| / mu. Called by compute_modes().
  /// @throws ConvergenceError
  void krylov_schur(const SecondOrderSystem &system, Flexibility &flexibility, unsigned int n_wanted,
                    Modes &modes, double tolerance = 1e-10);
} // namespace vibrocontact
