#pragma once

#include <vibrocontact/coupled_bodies/inertial_contact.h>
#include <vibrocontact/fe/dense_system.h>
#include <vibrocontact/reduction/modes.h>

#include <vector>

namespace vibrocontact
{
  /// A body of elements and its modes, which name the roots; null: a rigid body.
  struct FiniteElementBody
  {
    const SecondOrderSystem *system = nullptr;
    const Modes *modes = nullptr;
  };
  /// the bodies of a scene, in its order
  using FiniteElementPair = std::vector<FiniteElementBody>;

  /// dofs with mass: those that are neither held nor hanging. Collective.
  unsigned int n_moving_dofs(const FiniteElementPair &bodies);

  /// The finite elements of the bodies as dense matrices, replicated; held and hanging dofs are left out.
  /// Damping is modal, C = M Phi diag(2 zeta w) Phi^T M, with the ratios of the modes that the pair keeps:
  /// what these leave out is undamped. Collective.
  InertialPair finite_element_pair(const FiniteElementPair &bodies, const ContactPair &pair);
} // namespace vibrocontact
