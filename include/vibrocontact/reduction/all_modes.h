#pragma once

#include <vibrocontact/bodies/reduced_body.h>
#include <vibrocontact/reduction/modes.h>

namespace vibrocontact
{
  /// All modes of a small body, as many as it has dofs with mass: those kept as they are, in front, and the rest,
  /// ascending, from the dense problem on what is M-orthogonal to them,
  ///
  ///   Phi_k^T M Z = 0,    Z^T K Z y = w^2 Z^T M Z y,    phi = Z y.
  ///
  /// Dofs without mass (a massless contact node) follow the others statically and are condensed before.
  /// Pairs and signs as in orient_modes(). LAPACK, replicated; collective. @throws ConvergenceError
  Modes all_modes(const SecondOrderSystem &system, const Modes &kept);
} // namespace vibrocontact
