#pragma once

#include <vibrocontact/marching/probes.h>
#include <vibrocontact/run/prepare_bodies.h>

namespace vibrocontact
{
  /// The probes that `Transient/Signals/Probes` asks for, put on the surfaces of the bodies, and said in the
  /// log. To be called before prepare_pair(): shapes that the cache lacks are computed with the modes.
  /// @param unreduced surfaces of the bodies with the modes of the pair; empty: those of the modes kept
  /// @throws InputError. Collective.
  std::vector<Probe> transient_probes(const Parameters &parameters, const MeshedBodies &bodies,
                                      const std::vector<SurfaceShapes> &unreduced = {});

  /// Tells the probes where the modes of their bodies begin in the pair.
  void place_in_pair(const Parameters &parameters, const ContactPair &pair, std::vector<Probe> &probes);

  /// Asks the bodies for the shapes at their probes, before they are reduced for cases of a sweep. Collective.
  void request_probe_shapes(const Parameters &parameters, const MeshedBodies &bodies);
} // namespace vibrocontact
