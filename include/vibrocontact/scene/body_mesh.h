#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/types.h>
#include <deal.II/distributed/tria.h>

#include <array>
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
    /// cells of one type: hexahedra (2d: quadrilaterals) with manifolds attached, refined, or tetrahedra or prisms as
    /// they came, which every rank has all of (parallel::shared)
    std::unique_ptr<dealii::parallel::TriangulationBase<dim>> triangulation;
    /// boundary parts by name; faces of no named part have the id of `surface`
    std::map<std::string, dealii::types::boundary_id> boundaries;
    /// boundary ids on which contact points are sought
    std::set<dealii::types::boundary_id> contact_boundaries;
    /// names of the groups of cells that have a material each, empty: one material. A cell's group is its
    /// material id modulo their number; what the id holds beside it is the maker's (pieces of a rail).
    std::vector<std::string> cell_groups;
    /// polynomial degree of the mapping
    unsigned int geometry_degree = 2;
    /// Nodes in the middle of edges, quadrilateral faces and cells of a mesh of second order [m], by the vertices of the
    /// coarse mesh around them, ascending; edges and faces are filled up with no_vertex. Empty: the geometry is that of
    /// the triangulation's manifolds.
    using Around = std::array<unsigned int, 8>;
    static constexpr unsigned int no_vertex = dealii::numbers::invalid_unsigned_int;
    std::map<Around, dealii::Point<dim>> mid_nodes;

    /// the shape of all its cells
    dealii::ReferenceCell reference_cell() const { return triangulation->get_reference_cells().front(); }
    bool is_hypercube() const { return triangulation->all_reference_cells_are_hyper_cube(); }

    /// @throws InputError listing the names that exist if @p boundary is none of them.
    dealii::types::boundary_id boundary_id(const std::string &boundary) const;
  };
} // namespace vibrocontact
