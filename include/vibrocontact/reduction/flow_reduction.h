#pragma once

#include <vibrocontact/fe/material_flow.h>
#include <vibrocontact/reduction/modes.h>

namespace vibrocontact
{
  /// MaterialFlow in the modes Phi of the body at rest; kept in the cache by itself. Replicated.
  struct FlowReduction
  {
    /// Phi^T G Phi of both kinds of axes, n_modes square, antisymmetric [-]
    DenseMatrix fixed, turning;
    /// stretch of the modes at the contact points, n x n_modes [1/(m sqrt(kg))]
    DenseMatrix stretch;
    /// v of the modes at the places beyond the contact points, n_beyond x n_modes [1/sqrt(kg)], and what static forces on
    /// the contact rows do there, n_beyond x 3 n [m/N]
    DenseMatrix beyond, beyond_compliance;
  };

  /// @param system with flow. Collective.
  FlowReduction reduce_flow(const SecondOrderSystem &system, Flexibility &flexibility, const Modes &modes);
} // namespace vibrocontact
