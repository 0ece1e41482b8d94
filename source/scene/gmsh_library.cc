#include <vibrocontact/scene/gmsh_library.h>

#include <gmsh.h>

namespace vibrocontact
{
  void start_gmsh()
  {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.NumThreads", 1);
  }

  GmshNodes gmsh_nodes()
  {
    GmshNodes nodes;
    std::vector<std::size_t> tags;
    std::vector<double> coordinates, parameters;
    gmsh::model::mesh::getNodes(tags, coordinates, parameters);
    for (std::size_t k = 0; k < tags.size(); ++k)
    {
      nodes.number[tags[k]] = k;
      nodes.places.emplace_back(coordinates[3 * k], coordinates[3 * k + 1], coordinates[3 * k + 2]);
    }
    return nodes;
  }
} // namespace vibrocontact
