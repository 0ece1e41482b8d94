#pragma once

#include <vibrocontact/analyses/modal_convolution/road_contact.h>

#include <vector>

namespace vibrocontact
{
  /// How far a flat road has to be pushed towards a body at rest (or in steady rolling) so that both press with a given
  /// force, the hub being held:
  ///
  ///   gap = u_0 + G(0) q - (indentation - shape),     q_i = P(q_i, gap_i) by the normal law,     sum q = force
  ///
  /// G(0) the static receptance of the normal rows, residual and tread included, u_0 the displacement under the
  /// loads. Without friction, whatever the laws say of it.
  /// @param shapes height of the undeformed surface at each point [m], the model's first rows; @param force [N] > 0
  /// @return [m] @throws InputError if the body has no static response, that is not positive definite, or there is no such force
  double indentation_of_load(const BodyInContact &model, const std::vector<double> &shapes, double force,
                             const RoadLaws &laws = {});
} // namespace vibrocontact
