#pragma once

#include <map>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// The named groups of cells of a gmsh file (physical surfaces of a section, physical volumes of a solid).
  struct CellGroups
  {
    /// numbers of the groups that each cell belongs to; empty: none
    std::vector<std::vector<unsigned int>> groups;
    /// names by number; a group without a name is called by its number
    std::map<unsigned int, std::string> names;

    std::string name(const unsigned int group) const;
    /// Number of cells per group.
    std::map<std::string, unsigned int> counts() const;
    /// "steel (12 cells), rubber (3 cells)"
    std::string list() const;
  };

  /// What a parameter file says about the materials of a body: the entry `<body>/Materials`.
  struct GroupMaterials
  {
    /// name of the body
    std::string body;
    /// groups with a material each; empty: one material for the whole body
    std::vector<std::string> names;
  };

  /// Position in @p materials.names of each cell's material, 0 for all where the list is empty.
  /// @throws InputError for cells with no material or with two, for a material without cells, and for several
  ///   groups where the list is empty, so that one material would silently stand for all.
  std::vector<unsigned int> material_numbers(const CellGroups &cells, const GroupMaterials &materials,
                                             const std::string &file);
} // namespace vibrocontact
