#pragma once

#include <vibrocontact/output/results.h>
#include <vibrocontact/run/prepare_bodies.h>

#include <string>

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
  PoleBody pole_body(const Parameters &parameters, const MeshedBodies &bodies, unsigned int number,
                     const RoadParameters &road);

  /// The road of body 1: section Road, with the indentation at which a flat road presses with Rolling/Normal force if that
  /// is given (response/static_load.h).
  RoadParameters road_of(const Parameters &parameters, const PoleBody &body);

  /// The analysis `modal convolution` of body 1 on the road, with its output: results, histories.h5, a table per contact
  /// point (up to ten), impacts.csv, checkpoints as the transient's (modal_convolution.h5); with
  /// Comparison/Rows method_comparison.csv. Every rank steps, rank 0 writes. Collective.
  /// @param resume continue from the checkpoint in the folder; from the beginning if there is none
  void run_modal_convolution(const Parameters &parameters, const MeshedBodies &bodies,
                             const std::string &folder, bool resume, Results &results);
} // namespace vibrocontact
