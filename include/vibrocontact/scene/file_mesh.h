#pragma once

#include <vibrocontact/scene/element_type.h>

#include <deal.II/base/point.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace vibrocontact
{
  /// The elements of one type that belong to the same groups.
  struct FileElements
  {
    /// gmsh's number of the type
    unsigned int type = 0;
    /// physical groups of the elements' dimension; ascending
    std::vector<unsigned int> groups;
    /// positions in FileMesh::nodes, element by element, in gmsh's order
    std::vector<unsigned int> nodes;

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &type &groups &nodes;
    }
  };

  /// A mesh as a file describes it, whatever the format: elements of any kind, and the groups they belong to.
  struct FileMesh
  {
    /// [unit of the file]
    std::vector<dealii::Point<3>> nodes;
    std::vector<FileElements> elements;
    /// names by dimension and number of the group; groups without a name are called by their number
    std::map<std::pair<unsigned int, unsigned int>, std::string> names;

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &nodes &elements &names;
    }
  };

  /// Reads a mesh by the name's ending: `.msh` (gmsh, 2 and 4, text and binary), `.unv`, `.bdf`/`.nas` and `.vtk` by the
  /// gmsh library, `.inp` (Abaqus, CalculiX) by read_inp().
  ///
  /// gmsh's readers crash on damaged files and take what they do not know for a script that may start other programs:
  /// they see only files that begin as their format does, and run in a process of their own.
  /// @throws InputError for an unknown ending (MED: how to convert it), and for what cannot be read
  FileMesh read_file_mesh(const std::string &file);

  /// Reads a deck of Abaqus or CalculiX: *NODE, *ELEMENT (C3D4, C3D6, C3D8, C3D10, C3D15, C3D20 and their variants,
  /// shells as faces), *NSET, *ELSET, *SURFACE (faces of elements); everything else is skipped.
  ///
  /// Named groups of faces are surfaces, sets of shells, and sets of nodes: those boundary faces all of whose corners are
  /// in the set. Named groups of cells are sets of elements of which all are solid.
  /// @throws InputError with the line
  FileMesh read_inp(const std::string &file);
} // namespace vibrocontact
