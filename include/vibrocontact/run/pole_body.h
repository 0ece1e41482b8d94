#pragma once

#include <vibrocontact/reduction/pole_model.h>
#include <vibrocontact/run/measured_data.h>
#include <vibrocontact/run/prepare_bodies.h>

#include <vector>

namespace vibrocontact
{
  /// A body as a modal convolution sees it.
  struct PoleBody
  {
    /// rows of all points, upward; with friction then those forward
    PoleModel poles;
    /// of the contact points: place along the road, forward; height of the undeformed surface [m]
    std::vector<double> places, shapes;
    /// it does not roll: contact forces get back no more energy than they put in
    bool is_passive = true;
  };

  /// Oscillator and analytic ring by their closed forms, meshed bodies by their reduction. Collective.
  /// @param number of the body in the scene, from 0; @param road whose speed a rolling ring has
  PoleBody pole_body(const Parameters &parameters, const MeshedBodies &bodies,
                     const std::optional<MeasuredData> &measured, unsigned int number,
                     const RoadParameters &road);

  /// The road of body 1: section Road, with the indentation at which a flat road presses with Rolling/Normal force if that
  /// is given (response/static_load.h).
  RoadParameters road_of(const Parameters &parameters, const PoleBody &body);
} // namespace vibrocontact
