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
  /// `mass` is M without stored zeros. Called by compute_modes().
  /// @throws ConvergenceError
  void krylov_schur(const SecondOrderSystem &system, Flexibility &flexibility, Mat mass,
                    unsigned int n_wanted, Modes &modes);
} // namespace vibrocontact
