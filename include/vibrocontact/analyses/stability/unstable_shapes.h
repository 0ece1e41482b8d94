#pragma once

#include <vibrocontact/analyses/stability/stability.h>
#include <vibrocontact/run/prepare_bodies.h>

#include <string>

namespace vibrocontact
{
  /// The shapes of the unstable roots of a case on the surfaces of the meshed bodies, animated over one
  /// period:
  ///
  ///   u(phase) = Re(sum_k a_k phi_k exp(i phase)),   the largest amplitude of both bodies scaled to 1 mm
  ///
  /// unstable_<r>_<body>.pvd with fields/unstable_<r>_<body>_<frame>.vtu, r from 0 by ascending frequency. A
  /// body whose shapes are not kept beside its cached modes is left out, and that is said. Collective.
  void write_unstable_shapes(const StabilityResult &result, const ContactPair &pair,
                             const MeshedBodies &bodies, const std::string &folder);
} // namespace vibrocontact
