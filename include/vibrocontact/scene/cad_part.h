#pragma once

#include <vibrocontact/scene/cad_faces.h>
#include <vibrocontact/scene/file_mesh.h>

#include <string>

namespace vibrocontact
{
  /// Whether the ending of a file's name is that of a CAD format that can be meshed: .step, .stp, .brep.
  bool is_cad_file(const std::string &file);

  /// Whether a CAD file says its unit itself, so that its part is in metres (STEP).
  bool has_own_unit(const std::string &file);

  /// The solids of a CAD file and their faces, by gmsh's OpenCASCADE kernel in a process of its own. Kept as long as this process
  /// lives and the file is the same.
  /// @throws InputError for a file that is no CAD file, cut off, without a solid, or without a unit
  CadPart read_cad_part(const std::string &file);

  /// How a part is meshed [unit of the part].
  struct CadSizes
  {
    /// edge of a cell
    double cell_size = 0;
    /// at the fine faces, 0: as elsewhere; within `growth` of them it becomes cell_size
    double fine_size = 0, growth = 0;
    /// cells around a whole circle at least; 0: curved faces are not looked at
    unsigned int cells_around_circle = 12;
    /// of the geometry, 1 or 2
    unsigned int order = 2;
  };

  /// Tetrahedra of a CAD part with its groups of faces; those of a solid are the group of its name (CadSolid). Solids share nodes
  /// only where the file has one face for both.
  ///
  /// It is meshed once: the mesh is kept in a folder under a name made of the file's content, the sizes, the groups of faces and
  /// cells and gmsh's version.
  /// To be called by one rank. @param fine_faces numbers of the fine faces @param copy the mesh is written there too; empty: nowhere
  /// @param folder of the kept meshes; empty: none is kept @param keep whether a new mesh stays there
  /// @throws InputError if gmsh cannot mesh it
  FileMesh mesh_cad_part(const std::string &file, const CadSizes &sizes,
                         const std::map<std::string, std::vector<int>> &groups,
                         const std::vector<int> &fine_faces, const std::string &copy,
                         const std::string &folder, bool keep);
} // namespace vibrocontact
