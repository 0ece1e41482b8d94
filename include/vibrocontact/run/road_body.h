#pragma once

#include <vibrocontact/analyses/modal_convolution/road_contact.h>
#include <vibrocontact/bodies/body_in_contact.h>
#include <vibrocontact/run/measured_data.h>
#include <vibrocontact/run/prepare_bodies.h>

#include <vector>

namespace vibrocontact
{
  /// A body on a road.
  struct RoadBody
  {
    /// rows of all contact points, upward; with friction then those forward
    BodyInContact body;
    /// of the contact points: place along the road, forward; height of the surface that its modes and poles have not moved,
    /// constant loads on the rest included [m]
    std::vector<double> places = {}, shapes = {};
    /// points beside which the surface goes on, so that they have to stay open (points_at_open_sides())
    std::vector<unsigned int> at_open_sides = {};
    /// compliance of the tread under each contact point, which the residual has [m/N]
    double tread = 0;
    /// it does not roll: contact forces get back no more energy than they put in
    bool is_passive = true;
  };

  /// What the body on a road does there.
  struct RoadUse
  {
    /// whether there are rows forward
    bool friction = false;
    /// that a rolling ring turns at [m/s]; its material is differenced by Contact/Creep scheme
    double speed = 0;
    /// an identified body is made usable in contact at such a step of time [s]
    double contact_step = 0;
  };

  /// Oscillator and analytic ring by their closed forms, identified bodies by their poles, meshed ones by their reduction, at
  /// the points of all their contacts. Collective.
  /// @param number of the body in the scene, from 0
  RoadBody road_body(const Parameters &parameters, const MeshedBodies &bodies,
                     const std::optional<MeasuredData> &measured, unsigned int number, const RoadUse &use);
  /// The same of a reduction that is at hand, with its damping as section Modes scales it; null: of a body without mesh.
  RoadBody road_body(const Parameters &parameters, const ReducedBody *reduced,
                     const std::optional<MeasuredData> &measured, unsigned int number, const RoadUse &use);

  /// Where the points of the contacts' grids lie along the road, forward [m].
  std::vector<double> places_on_road(const Parameters &parameters);

  /// The laws of the contacts between it and the road.
  RoadLaws road_laws(const Parameters &parameters);

  /// The road of body 1: section Road, with the indentation at which a flat road presses with Rolling/Normal force if that
  /// is given (analyses/modal_convolution/static_load.h).
  RoadParameters road_of(const Parameters &parameters, const RoadBody &body);
} // namespace vibrocontact
