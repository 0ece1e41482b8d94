#pragma once

#include <vibrocontact/reduction/modes.h>

#include <vector>

namespace vibrocontact
{
  /// A body between a few of its points: given modes and the static flexibility that they leave out,
  ///
  ///   q'' + diag(2 zeta w) q' + diag(w^2) q = P^T R + load,    u = P q + residual R + residual_load
  ///
  /// rows of P: the points' motions. Replicated.
  struct PointReduction
  {
    /// n_points x n_modes [1/sqrt(kg)]
    DenseMatrix trace;
    /// P G P^T - sum over elastic modes P_k P_k^T / w_k^2; what is below 1e-10 of the whole compliance is rounding, and zero;
    /// n_points square [m/N]
    DenseMatrix residual;
    /// answers to the loads on the body: n_modes [N/sqrt(kg)], n_points [m]
    std::vector<double> load, residual_load;
  };

  /// Collective.
  PointReduction reduce_to_points(const SecondOrderSystem &system, Flexibility &flexibility,
                                  const Modes &modes, const std::vector<TraceRow> &points);
} // namespace vibrocontact
