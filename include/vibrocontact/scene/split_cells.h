#pragma once

#include <vibrocontact/scene/file_mesh.h>

#include <string>

namespace vibrocontact
{
  /// Hexahedra, prisms and pyramids of a mesh split into tetrahedra, of the order that they have; tetrahedra stay.
  ///
  /// Every quadrilateral face is cut by the diagonal through its smallest vertex number, so that neighbours agree without looking at
  /// each other (Dompierre, Labbe, Vallet, Camarero: How to subdivide pyramids, prisms and hexahedra into tetrahedra, 1999). A
  /// cell's tetrahedra join its smallest vertex with the triangles of the faces that it is not on:
  ///
  ///     7-------6      hexahedra: 6 tetrahedra, or 5 where no diagonal ends in the vertex opposite to the smallest;
  ///    /|      /|      prisms: 3;
  ///   4-------5 |      pyramids: 2.
  ///   | 3-----|-2
  ///   |/      |/
  ///   0-------1
  ///
  /// Of cells of second order edges keep their nodes. A diagonal's node is that of the face or the cell where the file has one,
  /// otherwise it lies where the shape functions of the nodes on the edges have it: - sum of corners / 4 + sum of edge nodes / 2 on a
  /// face, / 4 in a hexahedron. On a plane face with straight edges it is the diagonal's middle, which leaves the plane as it is and its
  /// triangles straight: so they are glued exactly.
  ///
  /// Quadrilaterals of the boundary become triangles by the same rule, each in its groups, as the tetrahedra are in the cell's.
  /// @throws InputError for quadrilateral faces that lie on two triangles with the other diagonal, with their number and the place
  ///   of the first
  FileMesh split_into_tetrahedra(const FileMesh &mesh, const std::string &file);
} // namespace vibrocontact
