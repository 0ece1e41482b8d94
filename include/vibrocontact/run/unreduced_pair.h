#pragma once

#include <vibrocontact/run/prepare_pair.h>

namespace vibrocontact
{
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

  /// The two bodies of the scene as their unreduced finite elements (with_all_modes()), and all modes on their
  /// surfaces; those of a body without mesh stay empty.
  struct UnreducedPair
  {
    std::unique_ptr<const PreparedPair> prepared;
    std::vector<SurfaceShapes> surfaces;
  };

  /// Assembles the bodies. To be called before the first analysis. Collective.
  /// @throws InputError if they have more than most_dense_dofs
  void check_unreduced_size(const MeshedBodies &bodies);

  /// Transient/Model = finite elements. Collective.
  UnreducedPair prepare_unreduced_pair(const Parameters &parameters, const MeshedBodies &bodies);
} // namespace vibrocontact
