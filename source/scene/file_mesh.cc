#include <vibrocontact/base/child_process.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/utf8.h>
#include <vibrocontact/scene/file_mesh.h>
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
#include <map>
#include <unordered_map>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    /// Whether a file begins as its format does.
    bool begins_rightly(const std::string &file, const std::string &format)
    {
      std::ifstream stream(file, std::ios::binary);
      std::string word;
      if (format == ".vtk")
      {
        std::getline(stream, word);
        return word.rfind("# vtk DataFile", 0) == 0;
      }
      if (format == ".unv")
        return bool(stream >> word) && word == "-1";
      if (format == ".msh")
        return bool(stream >> word) && (word == "$MeshFormat" || word == "$Comments");
      // Nastran: any card
      return true;
    }

    /// What gmsh has read, as it says it; in a process of its own.
    FileMesh mesh_of_gmsh(const std::string &file, const std::string &format)
    {
      std::unordered_map<std::size_t, unsigned int> tags_of;
      if (format == ".msh")
        tags_of = physical_tags_of_format_2(file);
      gmsh::initialize(0, nullptr, false);
      gmsh::option::setNumber("General.Terminal", 0);
      gmsh::option::setNumber("General.NumThreads", 1);
      gmsh::option::setNumber("General.AbortOnError", 0);
      gmsh::logger::start();
      gmsh::open(file);
      std::vector<std::string> log;
      gmsh::logger::get(log);
      for (const std::string &line : log)
        if (line.rfind("Error: ", 0) == 0)
          throw InputError(line.substr(7));

      FileMesh mesh;
      std::unordered_map<std::size_t, unsigned int> number;
      std::vector<std::size_t> tags;
      std::vector<double> coordinates, parameters;
      gmsh::model::mesh::getNodes(tags, coordinates, parameters);
      for (std::size_t k = 0; k < tags.size(); ++k)
      {
        number[tags[k]] = k;
        mesh.nodes.emplace_back(coordinates[3 * k], coordinates[3 * k + 1], coordinates[3 * k + 2]);
      }
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
        if (groups.empty() && format != ".msh")
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
              const auto found = number.find(nodes[t][e * n_nodes + k]);
              if (found == number.end())
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

    FileMesh read_by_gmsh(const std::string &file, const std::string &format)
    {
      const double size = std::filesystem::file_size(file);
      // gmsh needs some hundred bytes for a node of fifty
      const ChildResult result = run_in_child(
          [&]
          {
            const std::vector<char> packed = Utilities::pack(mesh_of_gmsh(file, format), false);
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
  } // namespace

  FileMesh read_file_mesh(const std::string &file)
  {
    if (!std::ifstream(file) || std::filesystem::is_directory(file))
      throw InputError("Cannot read the mesh file " + file + "; give the path of an existing file.");
    const std::string format = std::filesystem::path(file).extension().string();
    const std::map<std::string, std::string> read = {{".msh", ".msh"}, {".unv", ".unv"}, {".bdf", ".bdf"},
                                                     {".nas", ".bdf"}, {".vtk", ".vtk"}, {".inp", ".inp"}};
    if (format == ".med" || format == ".rmed")
      throw InputError(
          "The mesh file " + file +
          " is of format MED, which Debian's gmsh cannot read: save it as UNV (Salome: Export to "
          "UNV), which keeps the groups.");
    const auto known = read.find(format);
    if (known == read.end())
      throw InputError("The mesh file " + file + " has the ending \"" + format +
                       "\", by which no format is known: give .msh (gmsh), .unv, .bdf, .vtk or .inp (Abaqus, "
                       "CalculiX).");
    FileMesh mesh;
    if (format == ".inp")
      mesh = read_inp(file);
    else if (!begins_rightly(file, known->second))
      throw InputError("The mesh file " + file + " is no file of its format: " +
                       (format == ".msh"   ? std::string("it has no $MeshFormat at its beginning")
                        : format == ".unv" ? std::string("it has no -1 at its beginning")
                                           : std::string("it has no \"# vtk DataFile\" at its beginning")) +
                       "; save it again with the program that made it.");
    else
      mesh = read_by_gmsh(file, known->second);
    for (const Point<3> &p : mesh.nodes)
      if (!std::isfinite(p.norm()))
        throw InputError(
            "The mesh file " + file +
            " has a node whose coordinates are not finite; repair it in the program that made it.");
    return mesh;
  }
} // namespace vibrocontact
