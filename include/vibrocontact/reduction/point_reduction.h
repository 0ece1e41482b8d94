#pragma once

#include <vibrocontact/bodies/body_in_contact.h>
#include <vibrocontact/reduction/modes.h>

#include <vector>

namespace vibrocontact
{
  /// A body between a few of its points: given modes and, as residual, the static flexibility that they leave out,
  /// P G P^T - sum over elastic modes P_k P_k^T / w_k^2; rows of P: the points' motions. What is below 1e-10 of the whole
  /// compliance is rounding, and zero. Collective.
  /// @param damping_ratio of the modes
  BodyInContact reduce_to_points(const SecondOrderSystem &system, Flexibility &flexibility,
                                 const Modes &modes, const std::vector<double> &damping_ratio,
                                 const std::vector<TraceRow> &points);
} // namespace vibrocontact
