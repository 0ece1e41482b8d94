#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/scene/file_cells.h>
#include <vibrocontact/scene/split_cells.h>

#include <deal.II/base/bounding_box.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    using Around = std::array<unsigned int, 8>;

    Around around(std::vector<unsigned int> vertices)
    {
      std::sort(vertices.begin(), vertices.end());
      Around result;
      result.fill(numbers::invalid_unsigned_int);
      std::copy(vertices.begin(), vertices.end(), result.begin());
      return result;
    }

    std::string text_of(const Point<3> &p)
    {
      std::ostringstream text;
      text << "(" << p << ")";
      return text.str();
    }

    /// Numbers of elements by type and group, of those that match; "12 pyramids (8 in "steel", 4 in no group)".
    template <typename Match>
    std::string list_of(const FileMesh &mesh, const Match &matches)
    {
      std::map<unsigned int, std::map<std::string, std::size_t>> counts;
      for (const FileElements &block : mesh.elements)
      {
        const ElementType *const kind = element_type(block.type);
        if (!kind || !matches(*kind) || block.nodes.empty())
          continue;
        std::string group = "no group";
        if (!block.groups.empty())
        {
          const auto name = mesh.names.find({kind->dim, block.groups[0]});
          group = "\"" + (name == mesh.names.end() ? std::to_string(block.groups[0]) : name->second) + "\"";
        }
        counts[block.type][group] += block.nodes.size() / kind->n_nodes;
      }
      std::string text;
      for (const auto &[type, by_group] : counts)
      {
        std::string where;
        std::size_t n = 0;
        for (const auto &[group, count] : by_group)
        {
          n += count;
          where += (where.empty() ? "" : ", ") + std::to_string(count) + " in " + group;
        }
        text += (text.empty() ? "" : ", ") + std::to_string(n) + " " + element_type(type)->name + " (" +
                where + ")";
      }
      return text;
    }

    /// The type of all solid cells.
    unsigned int only_type(const FileMesh &mesh, const std::string &file)
    {
      std::set<unsigned int> types;
      for (const FileElements &block : mesh.elements)
      {
        const ElementType *const kind = element_type(block.type);
        if (!kind && !block.nodes.empty())
          throw InputError("The mesh file " + file + " holds elements of gmsh's type " +
                           std::to_string(block.type) +
                           ", of an order above two perhaps; save it with Mesh.ElementOrder = 1 or 2.");
        if (kind && kind->dim == 3 && !block.nodes.empty())
          types.insert(block.type);
      }
      const auto is_solid = [](const ElementType &kind) { return kind.dim == 3; };
      if (types.empty())
      {
        const std::string there = list_of(mesh, [](const ElementType &kind) { return kind.dim == 2; });
        throw InputError(
            "The mesh file " + file + " holds no solid cells" +
            (mesh.nodes.empty() ? " and no nodes: it is damaged, or of another format"
             : there.empty()    ? ", only " + std::to_string(mesh.nodes.size()) + " nodes"
                                : ", only " + there) +
            "; mesh the volume (gmsh -3), and where there are physical groups put the volume into one, "
            "or gmsh leaves it out.");
      }
      std::set<unsigned int> shapes, orders;
      for (const unsigned int type : types)
      {
        shapes.insert(element_type(type)->n_corners);
        orders.insert(element_type(type)->order);
      }
      if (types.size() > 1)
        throw InputError(
            "The mesh file " + file + " mixes " + list_of(mesh, is_solid) +
            ": a body has cells of one type and order, parts that are glued as well; " +
            (shapes.size() == 1 && orders.size() > 1
                 ? "mesh it with one Mesh.ElementOrder."
                 : "set Mesh/Split into tetrahedra to true, or mesh it in gmsh with tetrahedra alone "
                   "(no recombination) or hexahedra alone (Mesh.SubdivisionAlgorithm = 2); with one "
                   "Mesh.ElementOrder."));
      const ElementType &kind = *element_type(*types.begin());
      if (kind.n_corners == 5)
        throw InputError(
            "The mesh file " + file + " holds " + list_of(mesh, is_solid) +
            ", of which no body is made: set Mesh/Split into tetrahedra to true, or mesh it with "
            "hexahedra, tetrahedra or prisms.");
      return *types.begin();
    }

    struct MisplacedNodes
    {
      unsigned int n = 0;
      Point<3> first;
      void add(const Point<3> &place)
      {
        if (n++ == 0)
          first = place;
      }
    };

    /// The nodes between the corners, as far as the file has them; those of faces and cells follow from the edges.
    class MiddleNodes
    {
    public:
      MiddleNodes(FileCells &cells, const std::string &file) : cells(cells), file(file) {}

      void add(const std::vector<unsigned int> &corners, const Point<3> &place)
      {
        Point<3> mean;
        double length = 0;
        for (const unsigned int v : corners)
        {
          mean += cells.vertices[v] / double(corners.size());
          for (const unsigned int w : corners)
            length = std::max(length, cells.vertices[v].distance(cells.vertices[w]));
        }
        // an arc of 130 degrees is 0.29 of its chord high
        if (place.distance(mean) > 0.3 * length)
          far.add(place);
        const auto [found, is_new] = cells.mid_nodes.emplace(around(corners), place);
        if (!is_new && found->second.distance(place) > 1e-6 * length)
          torn.add(place);
      }

      void check() const
      {
        if (far.n > 0)
          throw InputError(
              "The mesh file " + file + " has " + std::to_string(far.n) +
              " middle nodes of cells further than 0.3 of the edge from its middle, the first at " +
              text_of(far.first) +
              " (unit of the file): mesh it finer there, or save it with first-order cells.");
        if (torn.n > 0)
          throw InputError(
              "The mesh file " + file + " has " + std::to_string(torn.n) +
              " hanging middle nodes, the first at " + text_of(torn.first) +
              " (unit of the file): two cells at one edge have different ones; merge them, or save it with "
              "first-order cells.");
      }

      /// Where the shape functions of cells with nodes on edges alone (20, 15 nodes) have the middle of a face.
      Point<3> middle_of(const std::vector<unsigned int> &corners) const
      {
        // corners -1/4 each and edges 1/2 on a face, edges 1/4 in a hexahedron
        Point<3> place;
        for (const unsigned int v : corners)
          place += Point<3>(-0.25 * cells.vertices[v]);
        const double share = corners.size() == 4 ? 0.5 : 0.25;
        for (unsigned int a = 0; a < corners.size(); ++a)
          for (unsigned int b = a + 1; b < corners.size(); ++b)
          {
            const auto edge = cells.mid_nodes.find(around({corners[a], corners[b]}));
            if (edge != cells.mid_nodes.end())
              place += Point<3>(share * edge->second);
          }
        return place;
      }

    private:
      FileCells &cells;
      const std::string &file;
      MisplacedNodes far, torn;
    };

    void add_middles(FileCells &cells, const FileMesh &mesh, const std::vector<unsigned int> &vertex_of,
                     const std::string &file)
    {
      const ElementType &kind = cells.kind();
      const auto lists = middles(cells.type);
      MiddleNodes nodes(cells, file);
      const auto corners_of =
          [&](const FileElements &block, const std::size_t first, const std::vector<unsigned int> &list)
      {
        std::vector<unsigned int> corners;
        for (const unsigned int c : list)
          corners.push_back(vertex_of[block.nodes[first + c]]);
        return corners;
      };
      const auto for_all = [&](const auto &action)
      {
        for (const FileElements &block : mesh.elements)
          if (block.type == cells.type)
            for (std::size_t first = 0; first < block.nodes.size(); first += kind.n_nodes)
              action(block, first);
      };
      for_all(
          [&](const FileElements &block, const std::size_t first)
          {
            for (unsigned int m = 0; m < lists.size(); ++m)
              nodes.add(corners_of(block, first, lists[m]),
                        mesh.nodes[block.nodes[first + kind.n_corners + m]]);
          });
      nodes.check();
      // of serendipity cells: the faces (and the middle) of the cell that has all nodes
      if (kind.whole == 0)
        return;
      const auto all = middles(kind.whole);
      for_all(
          [&](const FileElements &block, const std::size_t first)
          {
            for (unsigned int m = lists.size(); m < all.size(); ++m)
            {
              const auto corners = corners_of(block, first, all[m]);
              cells.mid_nodes.emplace(around(corners), nodes.middle_of(corners));
            }
          });
    }
  } // namespace

  std::map<std::string, unsigned int> FileCells::face_counts() const
  {
    std::map<std::string, unsigned int> counts;
    for (const auto &entry : names)
      counts[entry.second];
    for (const Face &face : faces)
      for (const unsigned int group : face.groups)
        ++counts[names.at(group)];
    return counts;
  }

  FileCells FileCells::read(const std::string &file, const bool split)
  {
    const FileMesh mesh = read_file_mesh(file);
    return solid_cells(split ? split_into_tetrahedra(mesh, file) : mesh, file);
  }

  FileCells solid_cells(const FileMesh &mesh, const std::string &file)
  {
    FileCells result;
    result.type = only_type(mesh, file);
    const ElementType &kind = result.kind();

    constexpr unsigned int none = numbers::invalid_unsigned_int;
    std::vector<unsigned int> vertex_of(mesh.nodes.size(), none);
    const auto vertex = [&](const unsigned int node)
    {
      if (vertex_of[node] == none)
      {
        vertex_of[node] = result.vertices.size();
        result.vertices.push_back(mesh.nodes[node]);
      }
      return vertex_of[node];
    };
    const std::array<unsigned int, 8> order = kind.is_hexahedron()
                                                  ? std::array<unsigned int, 8>{{0, 1, 3, 2, 4, 5, 7, 6}}
                                                  : std::array<unsigned int, 8>{{0, 1, 2, 3, 4, 5, 6, 7}};
    for (const FileElements &block : mesh.elements)
      if (block.type == result.type)
        for (std::size_t first = 0; first < block.nodes.size(); first += kind.n_nodes)
        {
          CellData<3> cell(kind.n_corners);
          for (unsigned int v = 0; v < kind.n_corners; ++v)
            cell.vertices[v] = vertex(block.nodes[first + order[v]]);
          result.cells.push_back(cell);
          result.groups.groups.push_back(block.groups);
        }
    for (const auto &[key, name] : mesh.names)
      if (key.first == 3)
        result.groups.names[key.second] = name;
      else if (key.first == 2)
        result.names[key.second] = name;

    // a face may be listed once for each of its groups
    std::map<Around, unsigned int> number;
    for (const FileElements &block : mesh.elements)
    {
      const ElementType *const face = element_type(block.type);
      if (!face || face->dim != 2 || block.groups.empty())
        continue;
      for (const unsigned int group : block.groups)
        if (result.names.count(group) == 0)
          result.names[group] = std::to_string(group);
      for (std::size_t first = 0; first < block.nodes.size(); first += face->n_nodes)
      {
        FileCells::Face one;
        one.groups = block.groups;
        for (unsigned int v = 0; v < face->n_corners; ++v)
          // a node of no cell: it is said where faces are sought
          one.corners.push_back(vertex(block.nodes[first + v]));
        const auto [found, is_new] = number.emplace(around(one.corners), result.faces.size());
        if (is_new)
          result.faces.push_back(one);
        else
        {
          std::vector<unsigned int> &groups = result.faces[found->second].groups;
          groups.insert(groups.end(), one.groups.begin(), one.groups.end());
          std::sort(groups.begin(), groups.end());
          groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
        }
      }
    }
    if (kind.order == 2)
      add_middles(result, mesh, vertex_of, file);
    return result;
  }

  void check_double_nodes(const FileCells &cells, const std::string &file, const std::set<std::string> &glued)
  {
    std::vector<bool> is_glued(cells.vertices.size(), false);
    for (const FileCells::Face &face : cells.faces)
      if (std::any_of(face.groups.begin(), face.groups.end(),
                      [&](const unsigned int group) { return glued.count(cells.names.at(group)) > 0; }))
        for (const unsigned int v : face.corners)
          is_glued[v] = true;
    const BoundingBox<3> box(cells.vertices);
    const double size = (box.get_boundary_points().second - box.get_boundary_points().first).norm(),
                 near = 1e-8 * size;
    // nodes of faces alone are named where these are sought
    std::vector<unsigned int> order;
    for (const CellData<3> &cell : cells.cells)
      order.insert(order.end(), cell.vertices.begin(), cell.vertices.end());
    std::sort(order.begin(), order.end());
    order.erase(std::unique(order.begin(), order.end()), order.end());
    std::sort(order.begin(), order.end(),
              [&](const unsigned int a, const unsigned int b)
              { return cells.vertices[a][0] < cells.vertices[b][0]; });
    unsigned int n = 0, first = 0;
    for (unsigned int k = 0; k < order.size(); ++k)
      for (unsigned int l = k + 1;
           l < order.size() && cells.vertices[order[l]][0] < cells.vertices[order[k]][0] + near; ++l)
        if (cells.vertices[order[l]].distance(cells.vertices[order[k]]) < near &&
            !(is_glued[order[k]] && is_glued[order[l]]) && n++ == 0)
          first = order[k];
    if (n > 0)
      throw InputError(
          "The mesh file " + file + " has " + std::to_string(n) + " double nodes, the first at " +
          text_of(cells.vertices[first]) +
          " (unit of the file): two nodes at one place make a crack; merge them (gmsh: Coherence Mesh), or "
          "glue their faces (Mesh/Glued).");
  }
} // namespace vibrocontact
