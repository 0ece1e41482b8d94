#include <vibrocontact/base/atomic_file.h>
#include <vibrocontact/base/exceptions.h>
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
        if (result.hexahedra.empty())
          damaged("holds no hexahedra: in gmsh recombine the surfaces and extrude, or set "
                  "Mesh.SubdivisionAlgorithm = 2");
        return std::move(result);
      }

    private:
      [[noreturn]] void damaged(const std::string &what) const
      {
        throw InputError("The mesh file " + name + " " + what + ".");
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
          const unsigned int dim = next<unsigned int>(), tag = next<unsigned int>();
          std::string text;
          std::getline(stream, text);
          const auto open = text.find('"'), close = text.rfind('"');
          if (open == close)
            damaged("has a physical name without quotes; save it again with gmsh");
          if (dim == 2)
            result.names[tag] = text.substr(open + 1, close - open - 1);
        }
      }

      void read_entities()
      {
        const unsigned int n[4] = {next<unsigned int>(), next<unsigned int>(), next<unsigned int>(),
                                   next<unsigned int>()};
        for (unsigned int d = 0; d < 3; ++d)
          for (unsigned int k = 0; k < n[d]; ++k)
          {
            const int entity = next<int>();
            for (unsigned int c = 0; c < (d == 0 ? 3 : 6); ++c)
              next<double>();
            for (unsigned int t = 0, n_tags = next<unsigned int>(); t < n_tags; ++t)
            {
              const int tag = std::abs(next<int>());
              if (d == 2 && t == 0)
                group_of_surface[entity] = tag;
            }
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

      void add_element(const unsigned int type, const unsigned int group, const unsigned int n_nodes)
      {
        unsigned int nodes[8];
        for (unsigned int v = 0; v < n_nodes; ++v)
        {
          const auto found = index.find(next<unsigned long>());
          if (found == index.end())
            damaged("has an element with a node that does not exist; save it again with gmsh");
          nodes[v] = found->second;
        }
        if (type == 5)
        {
          result.hexahedra.emplace_back();
          std::copy(nodes, nodes + 8, result.hexahedra.back().begin());
        }
        else if (type == 3)
        {
          result.quadrilaterals.push_back({{nodes[0], nodes[1], nodes[2], nodes[3]}});
          result.groups.push_back(group);
        }
      }

      unsigned int nodes_of(const unsigned int type) const
      {
        switch (type)
        {
        case 15:
          return 1;
        case 1:
          return 2;
        case 3:
          return 4;
        case 5:
          return 8;
        case 2:
        case 4:
        case 6:
        case 7:
          damaged("holds triangles, tetrahedra, prisms or pyramids; bodies are made of hexahedra only (in "
                  "gmsh recombine "
                  "and extrude, or set Mesh.SubdivisionAlgorithm = 2)");
        default:
          damaged("holds elements of type " + std::to_string(type) +
                  ", second-order ones perhaps; save it with Mesh.ElementOrder = 1");
        }
      }

      void read_elements()
      {
        if (version == 2.2)
        {
          for (unsigned int n = next<unsigned int>(); n > 0; --n)
          {
            next<unsigned long>();
            const unsigned int type = next<unsigned int>();
            unsigned int group = 0;
            for (unsigned int t = 0, n_tags = next<unsigned int>(); t < n_tags; ++t)
            {
              const int tag = next<int>();
              if (t == 0)
                group = std::abs(tag);
            }
            add_element(type, group, nodes_of(type));
          }
          return;
        }
        const unsigned int n_blocks = next<unsigned int>();
        for (unsigned int k = 0; k < 3; ++k)
          next<unsigned long>();
        for (unsigned int block = 0; block < n_blocks; ++block)
        {
          const unsigned int dim = next<unsigned int>();
          const int entity = next<int>();
          const unsigned int type = next<unsigned int>(), n = next<unsigned int>(), n_nodes = nodes_of(type);
          const auto group = group_of_surface.find(entity);
          for (unsigned int k = 0; k < n; ++k)
          {
            next<unsigned long>();
            add_element(type, dim == 2 && group != group_of_surface.end() ? group->second : 0, n_nodes);
          }
        }
      }

      const std::string name;
      std::ifstream stream;
      double version = 0;
      std::unordered_map<unsigned long, unsigned int> index;
      std::map<int, unsigned int> group_of_surface;
      GmshFile result;
    };
  } // namespace

  GmshFile GmshFile::read(const std::string &file)
  {
    return Reader(file).read();
  }

  std::map<std::string, unsigned int> GmshFile::face_counts() const
  {
    std::map<std::string, unsigned int> counts;
    for (const auto &entry : names)
      counts[entry.second];
    for (const unsigned int group : groups)
      if (names.count(group))
        ++counts[names.at(group)];
    return counts;
  }

  void write_gmsh(const BodyMesh<3> &mesh, const std::string &file, const double shift_y)
  {
    const auto &triangulation = *mesh.triangulation;
    const std::vector<Point<3>> &vertices = triangulation.get_vertices();
    std::vector<unsigned int> number(vertices.size(), 0);
    unsigned int n_nodes = 0, n_cells = 0;
    std::map<types::boundary_id, std::vector<std::array<unsigned int, 4>>> faces;
    for (const auto &cell : triangulation.cell_iterators_on_level(0))
    {
      ++n_cells;
      for (const unsigned int v : cell->vertex_indices())
        if (number[cell->vertex_index(v)] == 0)
          number[cell->vertex_index(v)] = ++n_nodes;
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
    // Physical tags are boundary ids plus one: gmsh has no tag 0.
    text << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n" << mesh.boundaries.size() + 1 << "\n";
    for (const auto &[name, id] : mesh.boundaries)
      text << "2 " << id + 1 << " \"" << name << "\"\n";
    text << "3 1 \"body\"\n$EndPhysicalNames\n$Entities\n0 0 " << faces.size() << " 1\n";
    for (const auto &entry : faces)
      text << entry.first + 1 << " 0 0 0 0 0 0 1 " << entry.first + 1 << " 0\n";
    text << "1 0 0 0 0 0 0 1 1 0\n$EndEntities\n$Nodes\n1 " << n_nodes << " 1 " << n_nodes << "\n3 1 0 "
         << n_nodes << "\n";
    std::vector<unsigned int> vertex_of(n_nodes);
    for (unsigned int v = 0; v < number.size(); ++v)
      if (number[v] > 0)
        vertex_of[number[v] - 1] = v;
    for (unsigned int k = 1; k <= n_nodes; ++k)
      text << k << "\n";
    for (const unsigned int v : vertex_of)
      text << vertices[v][0] << " " << vertices[v][1] + shift_y << " " << vertices[v][2] << "\n";
    unsigned int n_elements = n_cells, element = 0;
    for (const auto &entry : faces)
      n_elements += entry.second.size();
    text << "$EndNodes\n$Elements\n" << faces.size() + 1 << " " << n_elements << " 1 " << n_elements << "\n";
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
    text << "3 1 5 " << n_cells << "\n";
    for (const auto &cell : triangulation.cell_iterators_on_level(0))
    {
      text << ++element;
      for (const unsigned int v : {0, 1, 3, 2, 4, 5, 7, 6})
        text << " " << number[cell->vertex_index(v)];
      text << "\n";
    }
    text << "$EndElements\n";
    write_file(file, text.str());
  }
} // namespace vibrocontact
