#pragma once

#include <vibrocontact/scene/body_mesh.h>
#include <vibrocontact/scene/file_cells.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// A group of faces that an entry of section Mesh names.
  struct NamedGroup
  {
    std::string group, entry;
  };
  std::vector<std::string> group_names_of(const std::vector<NamedGroup> &groups);

  /// @param name of the body @param file for messages
  /// @throws InputError for a group without faces, with the groups there are and their counts
  void require_groups(const std::vector<NamedGroup> &groups, const FileCells &cells, const std::string &name,
                      const std::string &file);

  /// The boundary of each named face, and the names of the boundaries into @p mesh. Of several groups that a face belongs to it is
  /// the one which the section Mesh names, or else the one of the fewest faces; the others are no boundaries of the body then.
  /// @throws InputError if the section names several of them
  std::vector<dealii::types::boundary_id> boundary_ids(const std::vector<NamedGroup> &groups,
                                                       const FileCells &cells, BodyMesh<3> &mesh,
                                                       const std::string &file);

  /// Gives the faces of a coarse mesh their boundaries. @throws InputError for a named face that is no face of the boundary
  void name_faces(dealii::Triangulation<3> &triangulation, const FileCells &cells,
                  const std::vector<dealii::types::boundary_id> &ids, const std::string &file);
} // namespace vibrocontact
