#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/nearest_names.h>
#include <vibrocontact/scene/cell_groups.h>

#include <algorithm>
#include <set>

namespace vibrocontact
{
  std::string CellGroups::name(const unsigned int group) const
  {
    const auto found = names.find(group);
    return found == names.end() ? std::to_string(group) : found->second;
  }

  std::map<std::string, unsigned int> CellGroups::counts() const
  {
    std::map<std::string, unsigned int> result;
    for (const auto &own : groups)
      for (const unsigned int group : own)
        ++result[name(group)];
    return result;
  }

  std::string CellGroups::list() const
  {
    std::string text;
    for (const auto &[group, n] : counts())
      text += (text.empty() ? "" : ", ") + group + " (" + std::to_string(n) + " cells)";
    return text.empty() ? "none" : text;
  }

  namespace
  {
    /// One material for the whole body: more than one way of belonging to groups asks for more.
    void check_single_material(const CellGroups &cells, const std::string &entry, const std::string &file)
    {
      std::set<std::vector<unsigned int>> kinds(cells.groups.begin(), cells.groups.end());
      if (kinds.size() < 2)
        return;
      const auto counts = cells.counts();
      const auto n_none = std::count(cells.groups.begin(), cells.groups.end(), std::vector<unsigned int>());
      std::string names;
      for (const auto &group : counts)
        names += (names.empty() ? "" : ", ") + group.first;
      throw InputError("The mesh file " + file + " has groups of cells, " + cells.list() +
                       (n_none > 0 ? ", and " + std::to_string(n_none) + " cells of no group" : "") +
                       ", but one material for all of them: write " + entry + " = " + names +
                       " and a subsection of Material for each" +
                       (n_none > 0 ? ", and put every cell into a group" : "") + ".");
    }
  } // namespace

  std::vector<unsigned int> material_numbers(const CellGroups &cells, const GroupMaterials &materials,
                                             const std::string &file)
  {
    const std::string entry = materials.body + "/Materials";
    if (materials.names.empty())
    {
      check_single_material(cells, entry, file);
      return std::vector<unsigned int>(cells.groups.size(), 0);
    }
    const auto counts = cells.counts();
    for (const std::string &name : materials.names)
      if (counts.count(name) == 0)
        throw InputError(entry + " lists \"" + name + "\", but the mesh file " + file +
                         " has no cells in a physical group of this name; its groups: " + cells.list() + ".");

    std::vector<unsigned int> numbers;
    std::map<std::string, unsigned int> without;
    unsigned int n_without = 0;
    for (const auto &own : cells.groups)
    {
      std::vector<unsigned int> found;
      for (const unsigned int group : own)
      {
        const auto place = std::find(materials.names.begin(), materials.names.end(), cells.name(group));
        if (place != materials.names.end())
          found.push_back(place - materials.names.begin());
      }
      if (found.size() > 1)
        throw InputError("The mesh file " + file + " has cells that belong to \"" +
                         materials.names[found[0]] + "\" and to \"" + materials.names[found[1]] +
                         "\", both of which " + entry +
                         " lists: a cell has one material; take it out of one of the groups.");
      if (found.empty())
      {
        ++n_without;
        ++without[own.empty() ? "no group" : "\"" + cells.name(own.front()) + "\""];
      }
      numbers.push_back(found.empty() ? 0 : found.front());
    }
    if (n_without > 0)
    {
      std::string text;
      for (const auto &[group, n] : without)
        text += (text.empty() ? "" : ", ") + std::to_string(n) + " in " + group;
      throw InputError("The mesh file " + file + " has " + std::to_string(n_without) +
                       " cells without a material (" + text + "): add the group to " + entry +
                       " with its own subsection of Material, or put the cells into one of " +
                       quoted_list(materials.names) + ".");
    }
    return numbers;
  }
} // namespace vibrocontact
