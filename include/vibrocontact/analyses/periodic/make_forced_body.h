#pragma once

#include <vibrocontact/analyses/periodic/forced_body.h>
#include <vibrocontact/run/measured_data.h>
#include <vibrocontact/run/prepare_bodies.h>

namespace vibrocontact
{
  /// The bodies of the scene as periodic motion sees them: the motion of each contact point, of the first body there relative
  /// to the second, force and gap of section Periodic; points of Periodic/Contact points or of the contacts' grids, one grid
  /// after the other. Meshed bodies move by the modes kept, or all; rings, oscillators and identified bodies by their own,
  /// their contact points are those that they have on a road. Collective.
  /// @throws InputError for a free body, points that are not on it, or bodies that do not meet point by point
  ForcedBody forced_body(const Parameters &parameters, const MeshedBodies &bodies,
                         const std::optional<MeasuredData> &measured);

  /// Whether it can be made: the body is held, its points are on it. Its matrices are made, nothing is solved. Collective.
  /// @throws InputError as forced_body()
  void check_forced_points(const Parameters &parameters, const MeshedBodies &bodies);
} // namespace vibrocontact
