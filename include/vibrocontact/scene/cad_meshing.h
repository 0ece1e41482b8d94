#pragma once

#include <vibrocontact/base/entries_read.h>
#include <vibrocontact/scene/cad_part.h>
#include <vibrocontact/scene/flat_face.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_handler.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// Section CAD of a mesh body: how its STEP or BREP file is meshed, and which of its faces are groups.
  ///
  ///   size of a cell
  ///   Cell size          ........._________
  ///                           .'
  ///   Contact cell size  __.'               over the distance from the contact group's faces
  ///                      0    Growth distance
  struct CadMeshing
  {
    std::string faces;
    double cell_size = 0, contact_cell_size = 0, growth_distance = 0;
    unsigned int cells_around_circle = 12;
    /// also written here; empty: nowhere
    std::string copy;
    /// whether the mesh is kept in the cache
    bool keeps = true;

    void write_nothing()
    {
      copy.clear();
      keeps = false;
    }
    void declare_parameters(dealii::ParameterHandler &prm);
    /// Reads the file's faces, meshes nothing. @param section of the mesh body @param unit entry Unit [m]
    /// @param degree of the elements @param groups that the section Mesh names
    void check(const std::string &section, const std::string &file, double unit, unsigned int degree,
               const std::vector<std::string> &groups) const;
    void add_entries(EntriesRead &entries, const std::string &section, bool is_cad) const;
    /// The mesh, the same on all ranks. @param fine_group is meshed with Contact cell size
    /// @param folder of kept meshes, see mesh_cad_part()
    FileMesh mesh(const std::string &section, const std::string &file, unsigned int degree,
                  const std::string &fine_group, const std::string &folder, MPI_Comm communicator) const;
    /// See flat_contact_group(). @param place nominal contact point, @param unit [m]
    std::optional<FlatFace> flat_face(const std::string &file, const std::string &group,
                                      const std::vector<double> &place, double unit) const;

  private:
    /// Faces of each group of a part. @param entry that names them, for messages
    std::map<std::string, std::vector<int>> face_groups(const CadPart &part, const std::string &file,
                                                        const std::string &entry) const;
  };
} // namespace vibrocontact
