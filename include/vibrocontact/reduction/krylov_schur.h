#pragma once

#include <vibrocontact/reduction/modes.h>

namespace vibrocontact
{
  /// Solves G M phi = phi / w^2 by SLEPc's Krylov-Schur method, the factorised stiffness at shift 0 as its
  /// operator. Adds to `modes` the `n_wanted` lowest elastic modes that it does not have yet (perhaps some
  /// more), ascending. `mass` is M without stored zeros. Called by compute_modes().
  /// @throws ConvergenceError
  void krylov_schur(const SecondOrderSystem &system, Flexibility &flexibility, Mat mass,
                    unsigned int n_wanted, Modes &modes);
} // namespace vibrocontact
