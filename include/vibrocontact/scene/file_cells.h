#pragma once

#include <vibrocontact/scene/cell_groups.h>
#include <vibrocontact/scene/file_mesh.h>

#include <deal.II/grid/tria_description.h>

#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// The solid cells of one type in a mesh file, its named boundary faces and the nodes between the corners.
  struct FileCells
  {
    /// A face of a named group.
    struct Face
    {
      /// vertices, three or four, around it
      std::vector<unsigned int> corners;
      /// groups, ascending; empty: none
      std::vector<unsigned int> groups;
    };

    /// gmsh's number of the type
    unsigned int type = 0;
    /// corners of the cells [unit of the file]
    std::vector<dealii::Point<3>> vertices;
    /// in deal.II's order of the corners
    std::vector<dealii::CellData<3>> cells;
    std::vector<Face> faces;
    /// of faces and of cells
    std::map<unsigned int, std::string> names;
    CellGroups groups;
    /// further nodes of cells of second order, by the vertices around them, ascending and filled up with
    /// numbers::invalid_unsigned_int (BodyMesh::mid_nodes) [unit of the file]
    std::map<std::array<unsigned int, 8>, dealii::Point<3>> mid_nodes;

    const ElementType &kind() const { return *element_type(type); }
    /// Number of faces per named group.
    std::map<std::string, unsigned int> face_counts() const;

    /// @param split as split_into_tetrahedra() does @throws InputError what read_file_mesh() and solid_cells() refuse
    static FileCells read(const std::string &file, bool split = false);
  };

  /// The cells of a mesh.
  /// @throws InputError if there are none or of several types (with their numbers and groups and what to do), for middle
  ///   nodes that two cells see in two places or that lie far off their edge - with the place of the first
  FileCells solid_cells(const FileMesh &mesh, const std::string &file);

  /// Two corners at one place would be a crack, unless both are on glued faces.
  /// @param glued groups of faces @throws InputError with their number and the place of the first
  void check_double_nodes(const FileCells &cells, const std::string &file,
                          const std::set<std::string> &glued);
} // namespace vibrocontact
