#pragma once

#include <vector>

namespace vibrocontact
{
  /// The elements of gmsh by its numbers: nodes, dimension, order, plural of the name.
  struct ElementType
  {
    unsigned int n_nodes, dim, order;
    const char *name;
    /// its corners are its first nodes
    unsigned int n_corners;
    /// of cells without nodes in the middle of their faces: the type that has them all, else 0
    unsigned int whole = 0;
    bool is_hexahedron() const { return n_corners == 8; }
    /// about how many cubes hold as many nodes as one of them
    double cubes() const { return n_corners == 4 ? 0.2 : n_corners == 6 ? 0.5 : 1.; }
  };
  /// @return null for a number that is none of them: an order above two, or polygons
  const ElementType *element_type(unsigned int number);

  /// Corners of the edges and quadrilateral faces in whose middles the further nodes of a solid lie, in gmsh's order of
  /// these nodes: edges, then faces, then (hexahedra of 27 nodes) the middle of all corners.
  std::vector<std::vector<unsigned int>> middles(unsigned int number);
} // namespace vibrocontact
