#pragma once

#include <deal.II/base/types.h>
#include <deal.II/distributed/tria.h>

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// The mesh of one body with the names of its boundary parts, as every mesh maker hands it to the finite
  /// elements.
  ///
  /// Coordinates are those of the contact: origin at the nominal contact point, z up, x the rolling line.
  /// The makers (block.h, wheel.h, rail.h, mesh_file.h) refine where the scene has a contact grid.
  template <int dim>
  struct BodyMesh
  {
    std::string name;
    /// hexahedra (2d: quadrilaterals) with manifolds attached, refined
    std::unique_ptr<dealii::parallel::distributed::Triangulation<dim>> triangulation;
    /// boundary parts by name; faces of no named part have the id of `surface`
    std::map<std::string, dealii::types::boundary_id> boundaries;
    /// boundary ids on which contact points are sought
    std::set<dealii::types::boundary_id> contact_boundaries;
    /// names of the groups of cells that have a material each, empty: one material. A cell's group is its
    /// material id modulo their number; what the id holds beside it is the maker's (pieces of a rail).
    std::vector<std::string> cell_groups;
    /// polynomial degree of the mapping
    unsigned int geometry_degree = 2;

    /// @throws InputError listing the names that exist if @p boundary is none of them.
    dealii::types::boundary_id boundary_id(const std::string &boundary) const;
  };
} // namespace vibrocontact
