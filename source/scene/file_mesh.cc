#include <vibrocontact/base/child_process.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/utf8.h>
#include <vibrocontact/scene/file_mesh.h>
#include <vibrocontact/scene/gmsh_library.h>
#include <vibrocontact/scene/physical_tags.h>

#include <deal.II/base/utilities.h>

#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <unordered_map>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    /// What gmsh has read, as it says it; in a process of its own.
    FileMesh mesh_of_gmsh(const std::string &file, const bool names_groups)
    {
      std::unordered_map<std::size_t, unsigned int> tags_of;
      if (names_groups)
        tags_of = physical_tags_of_format_2(file);
      start_gmsh();
      gmsh::option::setNumber("General.AbortOnError", 0);
      gmsh::logger::start();
      gmsh::open(file);
      std::vector<std::string> log;
      gmsh::logger::get(log);
      for (const std::string &line : log)
        if (line.rfind("Error: ", 0) == 0)
          throw InputError(line.substr(7));

      const GmshNodes all_nodes = gmsh_nodes();
      FileMesh mesh;
      mesh.nodes = all_nodes.places;
      gmsh::vectorpair groups, entities;
      gmsh::model::getPhysicalGroups(groups);
      std::map<std::pair<int, int>, std::vector<unsigned int>> groups_of;
      for (const auto &[dim, tag] : groups)
      {
        std::string name;
        gmsh::model::getPhysicalName(dim, tag, name);
        mesh.names[{dim, tag}] = name.empty() ? std::to_string(tag) : as_utf8(name);
        std::vector<int> members;
        gmsh::model::getEntitiesForPhysicalGroup(dim, tag, members);
        for (const int entity : members)
          groups_of[{dim, entity}].push_back(tag);
      }
      gmsh::model::getEntities(entities);
      for (const auto &[dim, entity] : entities)
      {
        if (dim < 2)
          continue;
        std::vector<unsigned int> own = groups_of[{dim, entity}];
        if (groups.empty() && !names_groups)
        {
          own = {static_cast<unsigned int>(std::abs(entity))};
          mesh.names[{dim, own[0]}] = std::to_string(own[0]);
        }
        std::sort(own.begin(), own.end());
        std::vector<int> types;
        std::vector<std::vector<std::size_t>> elements, nodes;
        gmsh::model::mesh::getElements(types, elements, nodes, dim, entity);
        for (std::size_t t = 0; t < types.size(); ++t)
        {
          // by their groups: one for all, or of each element its own
          std::map<std::vector<unsigned int>, FileElements> blocks;
          const std::size_t n_nodes = elements[t].empty() ? 0 : nodes[t].size() / elements[t].size();
          for (std::size_t e = 0; e < elements[t].size(); ++e)
          {
            if (!tags_of.empty())
            {
              const auto tag = tags_of.find(elements[t][e]);
              own.clear();
              if (tag != tags_of.end() && tag->second > 0)
                own.push_back(tag->second);
            }
            FileElements &block = blocks[own];
            for (std::size_t k = 0; k < n_nodes; ++k)
            {
              const auto found = all_nodes.number.find(nodes[t][e * n_nodes + k]);
              if (found == all_nodes.number.end())
                throw InputError("an element has a node that does not exist");
              block.nodes.push_back(found->second);
            }
          }
          for (auto &[block_groups, block] : blocks)
          {
            block.type = types[t];
            block.groups = block_groups;
            mesh.elements.push_back(std::move(block));
          }
        }
      }
      return mesh;
    }

    /// @param names_groups an element without a group has none, as in gmsh's own format; of the others without any group each number
    ///   of a property or entity is one
    FileMesh read_by_gmsh(const std::string &file, const bool names_groups)
    {
      const double size = std::filesystem::file_size(file);
      // gmsh needs some hundred bytes for a node of fifty
      const ChildResult result = run_in_child(
          [&]
          {
            const std::vector<char> packed = Utilities::pack(mesh_of_gmsh(file, names_groups), false);
            return std::string(packed.begin(), packed.end());
          },
          60 + 2e-5 * size, 1e9 + 100 * size);
      if (result.crashed)
        throw InputError("gmsh breaks off (" + result.error + ") while it reads the mesh file " + file +
                         ": it is damaged; save it again with the program that made it.");
      if (!result.error.empty())
        throw InputError("gmsh cannot read the mesh file " + file + ": " + as_utf8(result.error) +
                         "; save it again with the program that made it.");
      return Utilities::unpack<FileMesh>(std::vector<char>(result.output.begin(), result.output.end()),
                                         false);
    }

    bool begins_as_gmsh(std::istream &stream)
    {
      std::string word;
      return bool(stream >> word) && (word == "$MeshFormat" || word == "$Comments");
    }

    bool begins_as_unv(std::istream &stream)
    {
      std::string word;
      return bool(stream >> word) && word == "-1";
    }

    bool begins_as_vtk(std::istream &stream)
    {
      std::string line;
      std::getline(stream, line);
      return line.rfind("# vtk DataFile", 0) == 0;
    }

    bool begins_with_anything(std::istream &)
    {
      return true;
    }

    /// A format by the ending of its files' names.
    struct Format
    {
      std::vector<std::string> endings;
      bool (*begins)(std::istream &);
      /// what its files have at their beginning
      std::string beginning;
      std::function<FileMesh(const std::string &)> read;
    };

    const std::vector<Format> &formats()
    {
      const auto with_groups = [](const std::string &file) { return read_by_gmsh(file, true); };
      const auto by_numbers = [](const std::string &file) { return read_by_gmsh(file, false); };
      static const std::vector<Format> all = {{{".msh"}, begins_as_gmsh, "$MeshFormat", with_groups},
                                              {{".unv"}, begins_as_unv, "-1", by_numbers},
                                              // Nastran: any card
                                              {{".bdf", ".nas"}, begins_with_anything, "", by_numbers},
                                              {{".vtk"}, begins_as_vtk, "\"# vtk DataFile\"", by_numbers},
                                              {{".inp"}, begins_with_anything, "", read_inp}};
      return all;
    }
  } // namespace

  FileMesh read_file_mesh(const std::string &file)
  {
    if (!std::ifstream(file) || std::filesystem::is_directory(file))
      throw InputError("Cannot read the mesh file " + file + "; give the path of an existing file.");
    const std::string ending = std::filesystem::path(file).extension().string();
    if (ending == ".med" || ending == ".rmed")
      throw InputError(
          "The mesh file " + file +
          " is of format MED, which Debian's gmsh cannot read: save it as UNV (Salome: Export to "
          "UNV), which keeps the groups.");
    const auto known = std::find_if(
        formats().begin(), formats().end(),
        [&](const Format &one) { return std::count(one.endings.begin(), one.endings.end(), ending) > 0; });
    if (known == formats().end())
      throw InputError("The mesh file " + file + " has the ending \"" + ending +
                       "\", by which no format is known: give .msh (gmsh), .unv, .bdf, .vtk or .inp (Abaqus, "
                       "CalculiX).");
    std::ifstream stream(file, std::ios::binary);
    if (!known->begins(stream))
      throw InputError("The mesh file " + file + " is no file of its format: it has no " + known->beginning +
                       " at its beginning; save it again with the program that made it.");
    FileMesh mesh = known->read(file);
    for (const Point<3> &p : mesh.nodes)
      if (!std::isfinite(p.norm()))
        throw InputError(
            "The mesh file " + file +
            " has a node whose coordinates are not finite; repair it in the program that made it.");
    return mesh;
  }
} // namespace vibrocontact
