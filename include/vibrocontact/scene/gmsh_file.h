#pragma once

#include <vibrocontact/scene/body_mesh.h>
#include <vibrocontact/scene/cell_groups.h>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// First-order cells and the named groups of a gmsh file (text, format 4.1 or 2.2): hexahedra and the
  /// quadrilaterals of their boundary, or the quadrilaterals of a section.
  struct GmshFile
  {
    /// nodes [unit of the file]; hexahedra and quadrilaterals by node index, in gmsh's order
    std::vector<dealii::Point<3>> nodes;
    std::vector<std::array<unsigned int, 8>> hexahedra;
    std::vector<std::array<unsigned int, 4>> quadrilaterals;
    /// physical group of each quadrilateral, 0: none; names of the groups of surfaces
    std::vector<unsigned int> groups;
    std::map<unsigned int, std::string> names;
    /// physical groups of the cells: of the hexahedra, or of a section's quadrilaterals
    CellGroups cells;

    /// @throws InputError if the file is missing, damaged, of another format, or holds elements that are no
    ///   first-order hexahedra (or quadrilaterals of their boundary); how many and in which groups is said.
    static GmshFile read(const std::string &file);
    /// A section: its cells are the quadrilaterals; anything but them, lines and points is refused.
    static GmshFile read_section(const std::string &file);

    /// Number of quadrilaterals per named group.
    std::map<std::string, unsigned int> face_counts() const;
  };

  /// Write the coarse cells, their groups and the named boundaries of a body; manifolds are not part of such
  /// a file.
  /// To be called by one rank; @p shift_y is added to y [m].
  void write_gmsh(const BodyMesh<3> &mesh, const std::string &file, double shift_y = 0);
} // namespace vibrocontact
