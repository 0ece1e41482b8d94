#pragma once

#include <vibrocontact/run/prepare_pair.h>

namespace vibrocontact
{
  /// The two bodies of the scene as their unreduced finite elements (with_all_modes()), and all modes on their
  /// surfaces; those of a body without mesh stay empty.
  struct UnreducedPair
  {
    std::unique_ptr<const PreparedPair> prepared;
    std::vector<SurfaceShapes> surfaces;
  };

  /// Assembles the bodies. To be called before the first analysis. Collective.
  /// @throws InputError if they have more than most_dense_dofs
  void check_unreduced_size(const MeshedBodies &bodies);

  /// Transient/Model = finite elements. Collective.
  UnreducedPair prepare_unreduced_pair(const Parameters &parameters, const MeshedBodies &bodies);
} // namespace vibrocontact
