#pragma once

#include <vibrocontact/periodic/periodic_body.h>
#include <vibrocontact/run/prepare_bodies.h>

namespace vibrocontact
{
  /// Body 1 of the scene as its periodic analysis sees it: modes (those kept, or all), force and contact points, stop and gap
  /// of section Periodic. Collective.
  /// @throws InputError for a free body, or points that are not on it
  PeriodicBody periodic_body(const Parameters &parameters, const MeshedBodies &bodies);

  /// Whether it can be made: the body is held, its points are on it. Its matrices are made, nothing is solved. Collective.
  /// @throws InputError as periodic_body()
  void check_periodic_points(const Parameters &parameters, const MeshedBodies &bodies);
} // namespace vibrocontact
