#pragma once

#include <vibrocontact/run/prepare_bodies.h>

namespace vibrocontact
{
  /// The two bodies of the scene as their unreduced finite elements (with_all_modes()), and all modes on their
  /// surfaces; those of a body without mesh stay empty.
  struct UnreducedPair
  {
    std::unique_ptr<const PreparedPair> prepared;
    std::vector<SurfaceShapes> surfaces;
  };

  /// Transient/Model = finite elements. Collective.
  /// @throws InputError if the bodies have more than most_dense_dofs
  UnreducedPair prepare_unreduced_pair(const Parameters &parameters, const MeshedBodies &bodies);
} // namespace vibrocontact
