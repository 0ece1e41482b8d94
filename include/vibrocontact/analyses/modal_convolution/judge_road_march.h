#pragma once

#include <vibrocontact/analyses/modal_convolution/modal_convolution.h>
#include <vibrocontact/output/results.h>

namespace vibrocontact
{
  /// Says on the screen and in `json`, the object of a modal convolution, what its second march tells about its errors
  /// (estimated_error, estimated_error_rms_force, estimated_error_worst_point, error_estimate), and how much of the road
  /// lies between the steps (unseen_road_share). What makes the result useless is a failure of @p results: an error
  /// beyond 20 %, an energy account open by more than 5 % of what there was and was put in, a body at rest that gives
  /// energy to the contact, waves of the road that the steps do not see, a contact that goes on beside its points.
  /// @param is_passive the body does not roll, so that its forces can give back no more than they got
  /// @param is_whole the run came to its end; otherwise nothing is a failure
  void judge_road_march(const ModalConvolutionParameters &parameters, const ModalConvolution &motion,
                        bool is_passive, bool is_whole, nlohmann::ordered_json &json, Results &results);
} // namespace vibrocontact
