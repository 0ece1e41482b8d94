#pragma once

#include <deal.II/base/point.h>

#include <cstddef>
#include <unordered_map>
#include <vector>

namespace vibrocontact
{
  /// Starts gmsh's library: silent, on one thread, so that a mesh is the same each time.
  void start_gmsh();

  /// The nodes of gmsh's current model.
  struct GmshNodes
  {
    /// [unit of the model]
    std::vector<dealii::Point<3>> places;
    /// position in places, by gmsh's tag
    std::unordered_map<std::size_t, unsigned int> number;
  };
  GmshNodes gmsh_nodes();
} // namespace vibrocontact
