#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/scene/split_cells.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <sstream>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    using Nodes = std::vector<unsigned int>;

    Nodes ascending(Nodes nodes)
    {
      std::sort(nodes.begin(), nodes.end());
      return nodes;
    }

    /// Corners of the faces of a solid in gmsh's order, each around the normal that points out.
    const std::vector<Nodes> &faces_of(const unsigned int n_corners)
    {
      static const std::map<unsigned int, std::vector<Nodes>> faces = {
          {4, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}},
          {5, {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}},
          {6, {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}},
          {8, {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}}};
      return faces.at(n_corners);
    }

    /// A face as triangles around the same normal, a quadrilateral cut through its smallest number.
    std::vector<Nodes> triangles_of(Nodes face)
    {
      if (face.size() == 3)
        return {face};
      std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
      return {{face[0], face[1], face[2]}, {face[0], face[2], face[3]}};
    }

    /// Corners of the tetrahedra of one cell. @param corners nodes in gmsh's order
    std::vector<Nodes> tetrahedra_of(const Nodes &corners)
    {
      if (corners.size() == 4)
        return {corners};
      const unsigned int smallest = *std::min_element(corners.begin(), corners.end());
      std::vector<Nodes> far;
      for (const Nodes &list : faces_of(corners.size()))
      {
        Nodes face;
        for (const unsigned int c : list)
          face.push_back(corners[c]);
        if (std::count(face.begin(), face.end(), smallest) == 0)
          for (const Nodes &triangle : triangles_of(face))
            far.push_back(triangle);
      }
      std::vector<Nodes> result;
      const auto add = [&](const unsigned int tip, const unsigned int a, const unsigned int b,
                           const unsigned int c) {
        result.push_back({tip, a, b, c});
      };
      if (corners.size() == 8)
      {
        // the corner between the far faces is cut off where it is on three of their triangles: no diagonal ends there
        constexpr unsigned int opposite[] = {6, 7, 4, 5, 2, 3, 0, 1};
        const unsigned int tip =
            corners[opposite[std::find(corners.begin(), corners.end(), smallest) - corners.begin()]];
        std::map<unsigned int, unsigned int> next;
        for (Nodes &triangle : far)
        {
          const auto at = std::find(triangle.begin(), triangle.end(), tip);
          if (at == triangle.end())
            continue;
          std::rotate(triangle.begin(), at, triangle.end());
          next[triangle[1]] = triangle[2];
        }
        if (next.size() == 3)
        {
          far.erase(std::remove_if(far.begin(), far.end(),
                                   [&](const Nodes &triangle) { return triangle[0] == tip; }),
                    far.end());
          const unsigned int a = next.begin()->first, b = next[a], c = next[b];
          far.push_back({a, b, c});
          add(tip, a, c, b);
        }
      }
      for (const Nodes &triangle : far)
        add(smallest, triangle[0], triangle[1], triangle[2]);
      return result;
    }

    class Splitting
    {
    public:
      Splitting(const FileMesh &given, const std::string &file) : given(given), file(file)
      {
        result.nodes = given.nodes;
        result.names = given.names;
        for (const FileElements &block : given.elements)
          for_solids(block,
                     [&](const ElementType &kind, const Nodes &nodes) { learn(kind, block.type, nodes); });
        check_corners();
        check_diagonals();
      }

      FileMesh split()
      {
        for (const FileElements &block : given.elements)
        {
          const ElementType *const kind = element_type(block.type);
          if (kind && kind->dim == 3)
            for_solids(block,
                       [&](const ElementType &type, const Nodes &nodes) { add_cell(type, block, nodes); });
          else if (kind && kind->dim == 2 && kind->n_corners == 4)
            for (std::size_t first = 0; first < block.nodes.size(); first += kind->n_nodes)
              for (const Nodes &triangle :
                   triangles_of({block.nodes.begin() + first, block.nodes.begin() + first + 4}))
                add(2, block.groups, triangle);
          else
            result.elements.push_back(block);
        }
        for (auto &[key, nodes] : blocks)
          result.elements.push_back({key.first, key.second, std::move(nodes)});
        return std::move(result);
      }

    private:
      using Edge = std::pair<unsigned int, unsigned int>;

      static Edge edge(const unsigned int a, const unsigned int b) { return std::minmax(a, b); }

      static Nodes corners_of(const Nodes &nodes, const Nodes &list)
      {
        Nodes corners;
        for (const unsigned int c : list)
          corners.push_back(nodes[c]);
        return ascending(corners);
      }

      template <typename Action>
      static void for_solids(const FileElements &block, const Action &action)
      {
        const ElementType *const kind = element_type(block.type);
        if (kind && kind->dim == 3)
          for (std::size_t first = 0; first < block.nodes.size(); first += kind->n_nodes)
            action(*kind, Nodes(block.nodes.begin() + first, block.nodes.begin() + first + kind->n_nodes));
      }

      /// Which faces and middle nodes there are.
      void learn(const ElementType &kind, const unsigned int type, const Nodes &nodes)
      {
        for (const Nodes &list : faces_of(kind.n_corners))
          list.size() == 4 ? void(++n_at_face[corners_of(nodes, list)])
                           : void(triangles.insert(corners_of(nodes, list)));
        const std::vector<Nodes> lists = middles(type);
        for (std::size_t m = 0; m < lists.size(); ++m)
        {
          const Nodes corners = corners_of(nodes, lists[m]);
          if (corners.size() < 8)
            node_between.emplace(corners, nodes[kind.n_corners + m]);
        }
      }

      template <typename Match>
      void refuse(const Match &matches, const std::string &what, const std::string &way_out) const
      {
        unsigned int n = 0;
        Point<3> first;
        for (const FileElements &block : given.elements)
          for_solids(block,
                     [&](const ElementType &kind, const Nodes &nodes)
                     {
                       for (const Nodes &found : matches(kind, nodes))
                         if (n++ == 0)
                           for (const unsigned int node : found)
                             first += (1. / found.size()) * given.nodes[node];
                     });
        if (n == 0)
          return;
        std::ostringstream text;
        text << "The mesh file " << file << " has " << n << " " << what << ", the first at (" << first
             << ") (unit of the file): " << way_out << ".";
        throw InputError(text.str());
      }

      /// Other programs write prisms as hexahedra of which two corners are one.
      void check_corners() const
      {
        refuse(
            [](const ElementType &kind, const Nodes &nodes) -> std::vector<Nodes>
            {
              const Nodes corners(nodes.begin(), nodes.begin() + kind.n_corners);
              if (std::set<unsigned int>(corners.begin(), corners.end()).size() == corners.size())
                return {};
              return {corners};
            },
            "cells with one node for two of their corners",
            "save them as the prisms, pyramids or tetrahedra that they are");
      }

      /// A face that is cut one way here and the other way there would be a crack.
      void check_diagonals() const
      {
        refuse(
            [&](const ElementType &kind, const Nodes &nodes)
            {
              std::vector<Nodes> crossed;
              for (const Nodes &list : faces_of(kind.n_corners))
              {
                if (list.size() != 4 || n_at_face.at(corners_of(nodes, list)) > 1)
                  continue;
                Nodes face;
                for (const unsigned int c : list)
                  face.push_back(nodes[c]);
                std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
                if (triangles.count(ascending({face[0], face[1], face[3]})) > 0 ||
                    triangles.count(ascending({face[1], face[2], face[3]})) > 0)
                  crossed.push_back(face);
              }
              return crossed;
            },
            "quadrilateral faces of cells on triangles of other cells that are cut along the other diagonal",
            "put pyramids between them in the program that made it, or part the cells and glue them "
            "(Mesh/Glued)");
      }

      void add(const unsigned int type, const Nodes &groups, const Nodes &nodes)
      {
        Nodes &block = blocks[{type, groups}];
        block.insert(block.end(), nodes.begin(), nodes.end());
      }

      void add_cell(const ElementType &kind, const FileElements &block, const Nodes &nodes)
      {
        const std::vector<Nodes> tetrahedra = tetrahedra_of({nodes.begin(), nodes.begin() + kind.n_corners});
        if (kind.order == 1)
        {
          for (const Nodes &corners : tetrahedra)
            add(4, block.groups, corners);
          return;
        }
        const std::map<Edge, unsigned int> middle = middles_in(kind, block.type, nodes, tetrahedra);
        for (Nodes corners : tetrahedra)
        {
          for (const Nodes &ends : middles(11))
            corners.push_back(middle.at(edge(corners[ends[0]], corners[ends[1]])));
          add(11, block.groups, corners);
        }
      }

      /// The nodes in the middle of all edges of a cell's tetrahedra.
      std::map<Edge, unsigned int> middles_in(const ElementType &kind, const unsigned int type,
                                              const Nodes &nodes, const std::vector<Nodes> &tetrahedra)
      {
        std::map<Edge, unsigned int> middle;
        std::map<Nodes, unsigned int> own;
        const std::vector<Nodes> lists = middles(type);
        for (std::size_t m = 0; m < lists.size(); ++m)
        {
          const Nodes corners = corners_of(nodes, lists[m]);
          own[corners] = nodes[kind.n_corners + m];
          if (corners.size() == 2)
            middle[edge(corners[0], corners[1])] = nodes[kind.n_corners + m];
        }
        const std::map<Edge, unsigned int> edges = middle;
        bool all_flat = true;
        for (const Nodes &list : faces_of(kind.n_corners))
          if (list.size() == 4)
          {
            Nodes face;
            for (const unsigned int c : list)
              face.push_back(nodes[c]);
            const Nodes diagonal = triangles_of(face).front();
            const auto of_cell = own.find(ascending(face));
            const std::optional<unsigned int> in_file = of_cell != own.end()
                                                            ? std::optional<unsigned int>(of_cell->second)
                                                            : find_node(ascending(face));
            const bool flat = is_flat(face, in_file, edges);
            all_flat = all_flat && flat;
            middle[edge(diagonal[0], diagonal[2])] =
                node_on({diagonal[0], diagonal[2]}, ascending(face), flat, in_file, edges);
          }
        if (kind.n_corners < 8)
          return middle;
        const Nodes corners = ascending({nodes.begin(), nodes.begin() + 8});
        for (const Nodes &one : tetrahedra)
          for (unsigned int a = 0; a < 4; ++a)
            for (unsigned int b = a + 1; b < 4; ++b)
              if (middle.count(edge(one[a], one[b])) == 0)
              {
                const auto of_cell = own.find(corners);
                middle[edge(one[a], one[b])] = all_flat               ? new_node_between(one[a], one[b])
                                               : of_cell != own.end() ? of_cell->second
                                                                      : new_node(corners, edges, 0.25);
              }
        return middle;
      }

      std::optional<unsigned int> find_node(const Nodes &around) const
      {
        const auto found = node_between.find(around);
        return found == node_between.end() ? std::nullopt : std::optional<unsigned int>(found->second);
      }

      /// Whether a quadrilateral is plane and its edges straight, to the digits that files have.
      bool is_flat(const Nodes &face, const std::optional<unsigned int> &node,
                   const std::map<Edge, unsigned int> &edges) const
      {
        const auto place = [&](const unsigned int n) { return given.nodes[n]; };
        double length = 0;
        for (unsigned int v = 0; v < 4; ++v)
          length = std::max(length, place(face[v]).distance(place(face[(v + 1) % 4])));
        const double near = 1e-5 * length;
        for (unsigned int v = 0; v < 4; ++v)
        {
          const unsigned int a = face[v], b = face[(v + 1) % 4];
          if (Point<3>((place(a) + place(b)) / 2).distance(place(edges.at(edge(a, b)))) > near)
            return false;
        }
        Tensor<1, 3> normal =
            cross_product_3d(place(face[2]) - place(face[0]), place(face[3]) - place(face[1]));
        normal /= std::max(normal.norm(), 1e-300);
        Nodes others = {face[1], face[2], face[3]};
        if (node)
          others.push_back(*node);
        return std::all_of(others.begin(), others.end(),
                           [&](const unsigned int n)
                           { return std::abs(normal * (place(n) - place(face[0]))) <= near; });
      }

      /// Of a diagonal: that of a tetrahedron there; its middle on a flat face, whose triangles keep straight edges; that of the face
      /// in the file; else a new one.
      unsigned int node_on(const Nodes &diagonal, const Nodes &corners, const bool flat,
                           const std::optional<unsigned int> &in_file,
                           const std::map<Edge, unsigned int> &edges)
      {
        if (const auto of_edge = find_node(ascending(diagonal)))
          return *of_edge;
        if (in_file && !flat)
          return *in_file;
        const auto known = new_on_face.find(corners);
        if (known != new_on_face.end())
          return known->second;
        return new_on_face[corners] =
                   flat ? new_node_between(diagonal[0], diagonal[1]) : new_node(corners, edges, 0.5);
      }

      unsigned int new_node_between(const unsigned int a, const unsigned int b)
      {
        result.nodes.push_back(Point<3>((given.nodes[a] + given.nodes[b]) / 2));
        return result.nodes.size() - 1;
      }

      unsigned int new_node(const Nodes &corners, const std::map<Edge, unsigned int> &edges,
                            const double share)
      {
        Point<3> place;
        for (const unsigned int node : corners)
          place += -0.25 * given.nodes[node];
        for (const auto &[ends, node] : edges)
          if (std::binary_search(corners.begin(), corners.end(), ends.first) &&
              std::binary_search(corners.begin(), corners.end(), ends.second))
            place += share * given.nodes[node];
        result.nodes.push_back(place);
        return result.nodes.size() - 1;
      }

      const FileMesh &given;
      const std::string &file;
      FileMesh result;
      std::map<std::pair<unsigned int, Nodes>, Nodes> blocks;
      /// cells at each quadrilateral face; triangular faces; middle nodes in the file, and new ones, by the corners around
      /// them. All ascending
      std::map<Nodes, unsigned int> n_at_face;
      std::set<Nodes> triangles;
      std::map<Nodes, unsigned int> node_between, new_on_face;
    };
  } // namespace

  FileMesh split_into_tetrahedra(const FileMesh &mesh, const std::string &file)
  {
    return Splitting(mesh, file).split();
  }
} // namespace vibrocontact
