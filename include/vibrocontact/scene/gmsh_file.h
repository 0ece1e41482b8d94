#pragma once

#include <vibrocontact/scene/body_mesh.h>
#include <vibrocontact/scene/cell_groups.h>

#include <array>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// The quadrilaterals of a section and their groups, of a gmsh file (text, format 4.1 or 2.2).
  ///
  /// Every run with a wheel or rail reads one on every rank. It is read here and not by gmsh's library (FileMesh), which
  /// crashes on damaged files and would need a process of its own each time.
  struct GmshFile
  {
    /// nodes [unit of the file]; quadrilaterals by node index, in gmsh's order
    std::vector<dealii::Point<3>> nodes;
    std::vector<std::array<unsigned int, 4>> quadrilaterals;
    /// physical groups of the quadrilaterals
    CellGroups cells;

    /// @throws InputError if the file is missing, damaged, of another format, or holds cells other than first-order
    ///   quadrilaterals; how many and in which groups is said.
    static GmshFile read_section(const std::string &file);
  };

  /// Write the coarse cells, their groups and the named boundaries of a body; manifolds are not part of such
  /// a file.
  /// To be called by one rank; @p shift_y is added to y [m].
  void write_gmsh(const BodyMesh<3> &mesh, const std::string &file, double shift_y = 0);
} // namespace vibrocontact
