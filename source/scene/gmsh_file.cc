#include <vibrocontact/base/atomic_file.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/utf8.h>
#include <vibrocontact/scene/file_mesh.h>
#include <vibrocontact/scene/gmsh_file.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <type_traits>
#include <unordered_map>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    /// no count or tag of a file that could be read is larger
    constexpr long long largest_count = 2000000000;

    constexpr unsigned int quadrilateral_type = 3;

    class Reader
    {
    public:
      explicit Reader(const std::string &name) : name(name), stream(name)
      {
        if (!stream)
          throw InputError("Cannot read the mesh file " + name + "; give the path of an existing gmsh file.");
      }

      GmshFile read()
      {
        std::string section;
        while (stream >> section)
        {
          if (section == "$MeshFormat")
            read_format();
          else if (section == "$PhysicalNames")
            read_names();
          else if (section == "$Entities")
            read_entities();
          else if (section == "$Nodes")
            read_nodes();
          else if (section == "$Elements")
            read_elements();
          if (section.front() == '$' && section.compare(0, 4, "$End") != 0)
            skip_to("$End" + section.substr(1));
        }
        if (version == 0)
          damaged("has no $MeshFormat: it is no gmsh file; give one that gmsh saved as text, format 4.1");
        check_strays();
        if (result.quadrilaterals.empty())
          damaged("holds no quadrilaterals: in gmsh recombine the surfaces of the section");
        return std::move(result);
      }

    private:
      [[noreturn]] void damaged(const std::string &what) const
      {
        throw InputError("The mesh file " + name + " " + as_utf8(what) + ".");
      }

      /// Elements of which no body is made, with their number and groups.
      void check_strays() const
      {
        if (strays.empty())
          return;
        std::string text;
        for (const auto &[type, groups] : strays)
        {
          std::string where;
          unsigned int n = 0;
          for (const auto &[group, count] : groups)
          {
            n += count;
            where += (where.empty() ? "" : ", ") + std::to_string(count) + " in " + group;
          }
          text += (text.empty() ? "" : ", ") + std::to_string(n) + " " + element_type(type)->name + " (" +
                  where + ")";
        }
        damaged("holds " + text + " beside " + std::to_string(result.quadrilaterals.size()) +
                " first-order quadrilaterals, of which alone sections are made: in gmsh recombine all "
                "surfaces or "
                "set Mesh.SubdivisionAlgorithm = 1, and Mesh.ElementOrder = 1");
      }

      template <typename T>
      T next()
      {
        // a stream turns "-1" into a huge unsigned number without complaint
        using Read = std::conditional_t<std::is_unsigned_v<T>, long long, T>;
        Read value;
        if (!(stream >> value))
          damaged("ends too early or holds text where a number is due; save it again with gmsh");
        if constexpr (std::is_unsigned_v<T>)
          if (value < 0 || value > largest_count)
            damaged("holds " + std::to_string(value) +
                    " where a count, a tag or a type is due; save it again with gmsh");
        return static_cast<T>(value);
      }

      void skip_to(const std::string &end)
      {
        std::string word;
        while (stream >> word)
          if (word == end)
            return;
        damaged("ends too early: " + end + " is missing; save it again with gmsh");
      }

      void read_format()
      {
        version = next<double>();
        if (next<int>() != 0)
          damaged("is binary; save it as text (gmsh option -format msh41 without -bin)");
        if (version != 2.2 && version != 4.1)
          damaged("has format " + std::to_string(version).substr(0, 3) +
                  "; save it as 4.1 (gmsh -format msh41)");
      }

      void read_names()
      {
        for (unsigned int n = next<unsigned int>(); n > 0; --n)
        {
          const unsigned int group_dim = next<unsigned int>(), tag = next<unsigned int>();
          std::string text;
          std::getline(stream, text);
          const auto open = text.find('"'), close = text.rfind('"');
          if (open == std::string::npos || close == open)
            damaged("has a physical name without quotes; save it again with gmsh");
          const std::string group = as_utf8(text.substr(open + 1, close - open - 1));
          names[{group_dim, tag}] = group;
          if (group_dim == 2)
            result.cells.names[tag] = group;
        }
      }

      void read_entities()
      {
        const unsigned int n[4] = {next<unsigned int>(), next<unsigned int>(), next<unsigned int>(),
                                   next<unsigned int>()};
        for (unsigned int d = 0; d < 4; ++d)
          for (unsigned int k = 0; k < n[d]; ++k)
          {
            const int entity = next<int>();
            for (unsigned int c = 0; c < (d == 0 ? 3 : 6); ++c)
              next<double>();
            auto &groups = groups_of[{d, entity}];
            for (unsigned int t = next<unsigned int>(); t > 0; --t)
              groups.push_back(std::abs(next<int>()));
            if (d > 0)
              for (unsigned int b = next<unsigned int>(); b > 0; --b)
                next<int>();
          }
      }

      void add_node(const unsigned long tag, const Point<3> &p)
      {
        for (unsigned int d = 0; d < 3; ++d)
          if (!std::isfinite(p[d]))
            damaged("has a node whose coordinates are not finite; repair it in gmsh");
        index[tag] = result.nodes.size();
        result.nodes.push_back(p);
      }

      Point<3> next_point()
      {
        Point<3> p;
        for (unsigned int d = 0; d < 3; ++d)
          p[d] = next<double>();
        return p;
      }

      void read_nodes()
      {
        if (version == 2.2)
        {
          for (unsigned int n = next<unsigned int>(); n > 0; --n)
          {
            const unsigned long tag = next<unsigned long>();
            add_node(tag, next_point());
          }
          return;
        }
        const unsigned int n_blocks = next<unsigned int>();
        for (unsigned int k = 0; k < 3; ++k)
          next<unsigned long>();
        for (unsigned int block = 0; block < n_blocks; ++block)
        {
          next<int>();
          next<int>();
          if (next<int>() != 0)
            damaged("holds parametric coordinates; save it with Mesh.SaveParametric = 0");
          std::vector<unsigned long> tags; // grows with what is there, not with what the file claims
          for (unsigned int n = next<unsigned int>(); n > 0; --n)
            tags.push_back(next<unsigned long>());
          for (const auto tag : tags)
            add_node(tag, next_point());
        }
      }

      /// @param groups physical groups of the element's entity, of its own dimension
      void add_element(const unsigned int type, std::vector<unsigned int> groups)
      {
        const ElementType &kind = *element_type(type);
        // lines and points carry nothing
        if (type != quadrilateral_type && kind.dim > 1)
        {
          ++strays[type][groups.empty() ? "no group" : "\"" + group_name(kind.dim, groups[0]) + "\""];
          std::string rest_of_line;
          std::getline(stream, rest_of_line);
          return;
        }
        unsigned int nodes[8];
        for (unsigned int v = 0; v < kind.n_nodes; ++v)
        {
          const auto found = index.find(next<unsigned long>());
          if (found == index.end())
            damaged("has an element with a node that does not exist; save it again with gmsh");
          nodes[v] = found->second;
        }
        if (type == quadrilateral_type)
        {
          result.quadrilaterals.push_back({{nodes[0], nodes[1], nodes[2], nodes[3]}});
          std::sort(groups.begin(), groups.end());
          result.cells.groups.push_back(std::move(groups));
        }
      }

      std::string group_name(const unsigned int group_dim, const unsigned int group) const
      {
        const auto found = names.find({group_dim, group});
        return found == names.end() ? std::to_string(group) : found->second;
      }

      unsigned int known_type(const unsigned int type) const
      {
        if (!element_type(type))
          damaged("holds elements of gmsh's type " + std::to_string(type) +
                  ", of an order above two perhaps; save it with Mesh.ElementOrder = 1");
        return type;
      }

      void read_elements()
      {
        if (version == 2.2)
        {
          for (unsigned int n = next<unsigned int>(); n > 0; --n)
          {
            next<unsigned long>();
            const unsigned int type = known_type(next<unsigned int>());
            unsigned int group = 0;
            for (unsigned int t = 0, n_tags = next<unsigned int>(); t < n_tags; ++t)
            {
              const int tag = next<int>();
              if (t == 0)
                group = std::abs(tag);
            }
            add_element(type, group == 0 ? std::vector<unsigned int>() : std::vector<unsigned int>{group});
          }
          return;
        }
        const unsigned int n_blocks = next<unsigned int>();
        for (unsigned int k = 0; k < 3; ++k)
          next<unsigned long>();
        for (unsigned int block = 0; block < n_blocks; ++block)
        {
          const unsigned int entity_dim = next<unsigned int>();
          const int entity = next<int>();
          const unsigned int type = known_type(next<unsigned int>());
          if (element_type(type)->dim != entity_dim)
            damaged("says that an entity of dimension " + std::to_string(entity_dim) + " holds " +
                    element_type(type)->name + "; save it again with gmsh");
          const auto found = groups_of.find({entity_dim, entity});
          const std::vector<unsigned int> groups =
              found == groups_of.end() ? std::vector<unsigned int>() : found->second;
          for (unsigned int n = next<unsigned int>(); n > 0; --n)
          {
            next<unsigned long>();
            add_element(type, groups);
          }
        }
      }

      const std::string name;
      std::ifstream stream;
      double version = 0;
      std::unordered_map<unsigned long, unsigned int> index;
      /// names of the physical groups by dimension and number; groups by dimension and number of the entity
      std::map<std::pair<unsigned int, unsigned int>, std::string> names;
      std::map<std::pair<unsigned int, int>, std::vector<unsigned int>> groups_of;
      /// number of elements that do not belong here, by type and group
      std::map<unsigned int, std::map<std::string, unsigned int>> strays;
      GmshFile result;
    };
  } // namespace

  GmshFile GmshFile::read_section(const std::string &file)
  {
    return Reader(file).read();
  }

  void write_gmsh(const BodyMesh<3> &mesh, const std::string &file, const double shift_y)
  {
    const auto &triangulation = *mesh.triangulation;
    const std::vector<Point<3>> &vertices = triangulation.get_vertices();
    std::vector<unsigned int> number(vertices.size(), 0);
    unsigned int n_nodes = 0;
    const std::vector<std::string> groups =
        mesh.cell_groups.empty() ? std::vector<std::string>{"body"} : mesh.cell_groups;
    std::vector<std::vector<std::array<unsigned int, 8>>> cells(groups.size());
    std::map<types::boundary_id, std::vector<std::array<unsigned int, 4>>> faces;
    for (const auto &cell : triangulation.cell_iterators_on_level(0))
    {
      for (const unsigned int v : cell->vertex_indices())
        if (number[cell->vertex_index(v)] == 0)
          number[cell->vertex_index(v)] = ++n_nodes;
      std::array<unsigned int, 8> nodes;
      for (const unsigned int v : {0, 1, 2, 3, 4, 5, 6, 7})
        nodes[v] = number[cell->vertex_index(v)];
      cells[cell->material_id() % groups.size()].push_back(nodes);
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary())
        {
          const auto face = cell->face(f);
          faces[face->boundary_id()].push_back(
              {{face->vertex_index(0), face->vertex_index(1), face->vertex_index(3), face->vertex_index(2)}});
        }
    }
    std::ostringstream text;
    text.precision(17);
    // Physical tags are boundary ids or numbers of groups plus one: gmsh has no tag 0.
    text << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n"
         << mesh.boundaries.size() + groups.size() << "\n";
    for (const auto &[name, id] : mesh.boundaries)
      text << "2 " << id + 1 << " \"" << name << "\"\n";
    for (unsigned int g = 0; g < groups.size(); ++g)
      text << "3 " << g + 1 << " \"" << groups[g] << "\"\n";
    text << "$EndPhysicalNames\n$Entities\n0 0 " << faces.size() << " " << groups.size() << "\n";
    for (const auto &entry : faces)
      text << entry.first + 1 << " 0 0 0 0 0 0 1 " << entry.first + 1 << " 0\n";
    for (unsigned int g = 1; g <= groups.size(); ++g)
      text << g << " 0 0 0 0 0 0 1 " << g << " 0\n";
    text << "$EndEntities\n$Nodes\n1 " << n_nodes << " 1 " << n_nodes << "\n3 1 0 " << n_nodes << "\n";
    std::vector<unsigned int> vertex_of(n_nodes);
    for (unsigned int v = 0; v < number.size(); ++v)
      if (number[v] > 0)
        vertex_of[number[v] - 1] = v;
    for (unsigned int k = 1; k <= n_nodes; ++k)
      text << k << "\n";
    for (const unsigned int v : vertex_of)
      text << vertices[v][0] << " " << vertices[v][1] + shift_y << " " << vertices[v][2] << "\n";
    unsigned int n_elements = 0, element = 0;
    for (const auto &entry : faces)
      n_elements += entry.second.size();
    for (const auto &list : cells)
      n_elements += list.size();
    text << "$EndNodes\n$Elements\n"
         << faces.size() + groups.size() << " " << n_elements << " 1 " << n_elements << "\n";
    for (const auto &[id, list] : faces)
    {
      text << "2 " << id + 1 << " 3 " << list.size() << "\n";
      for (const auto &face : list)
      {
        text << ++element;
        for (const unsigned int v : face)
          text << " " << number[v];
        text << "\n";
      }
    }
    for (unsigned int g = 0; g < groups.size(); ++g)
    {
      text << "3 " << g + 1 << " 5 " << cells[g].size() << "\n";
      for (const auto &cell : cells[g])
      {
        text << ++element;
        for (const unsigned int v : {0, 1, 3, 2, 4, 5, 7, 6})
          text << " " << cell[v];
        text << "\n";
      }
    }
    text << "$EndElements\n";
    write_file(file, text.str());
  }
} // namespace vibrocontact
