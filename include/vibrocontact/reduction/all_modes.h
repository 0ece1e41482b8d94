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

  /// The finite elements themselves, unreduced, in the form of a reduced body: the change of basis to all modes
  /// takes nothing away. The residual flexibility becomes zero (or that of massless dofs, if there are any), the contact points have the mass that
  /// the elements give them, and a step of the theta method has the response
  ///
  ///   Psi diag(1 / (1 + h theta c + h^2 theta^2 w^2)) Psi^T = P_c (M + h theta C + h^2 theta^2 K)^-1 P_c^T,
  ///
  /// C = M Phi diag(2 zeta w) Phi^T M: the modes that `body` keeps have their damping ratios and names, what
  /// they leave out is undamped and goes by its number.
  /// @param all all_modes() of the modes that `body` keeps
  ReducedBody with_all_modes(ReducedBody body, const SecondOrderSystem &system, const Modes &all);
} // namespace vibrocontact
