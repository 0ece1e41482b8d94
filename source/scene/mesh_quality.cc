#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/scene/mesh_quality.h>

#include <deal.II/base/tensor.h>
#include <deal.II/grid/reference_cell.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <sstream>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    constexpr double degenerate_corner = 1e-6, sliver_corner = 1e-3, sliver_edge = 1e-4, poor_corner = 0.05,
                     poor_edge = 1e-2;
    constexpr double most_unknowns = 2e7;

    /// Corners joined to each corner of a cell by edges, so that they are right-handed.
    using Neighbours = std::vector<std::array<unsigned int, 3>>;

    template <int dim>
    const Neighbours &neighbours(const CellData<dim> &cell)
    {
      static const Neighbours quadrilateral = {{{1, 2}}, {{3, 0}}, {{0, 3}}, {{2, 1}}},
                              tetrahedron = {{{1, 2, 3}}, {{2, 0, 3}}, {{0, 1, 3}}, {{0, 2, 1}}},
                              prism = {{{1, 2, 3}}, {{2, 0, 4}}, {{0, 1, 5}},
                                       {{5, 4, 0}}, {{3, 5, 1}}, {{4, 3, 2}}},
                              hexahedron = {{{1, 2, 4}}, {{3, 0, 5}}, {{0, 3, 6}}, {{2, 1, 7}},
                                            {{6, 5, 0}}, {{4, 7, 1}}, {{7, 4, 2}}, {{5, 6, 3}}};
      if (dim == 2)
        return quadrilateral;
      return cell.vertices.size() == 4 ? tetrahedron : cell.vertices.size() == 6 ? prism : hexahedron;
    }

    template <int dim>
    ReferenceCell shape_of(const CellData<dim> &cell)
    {
      return ReferenceCell::n_vertices_to_type(dim, cell.vertices.size());
    }

    /// Cells of one kind of fault: their number and the first of them.
    template <int dim>
    struct Fault
    {
      unsigned int n = 0, first = 0, n_corners = 0;
      Point<dim> place;

      void add(const unsigned int cell, const CellData<dim> &data, const Point<dim> &where)
      {
        if (n++ > 0)
          return;
        first = cell + 1;
        n_corners = data.vertices.size();
        place = where;
      }
      std::string text(const std::string &kind) const
      {
        std::ostringstream out;
        out << n << " " << kind
            << (dim == 2         ? " quadrilaterals"
                : n_corners == 4 ? " tetrahedra"
                : n_corners == 6 ? " prisms"
                                 : " hexahedra")
            << ", the first is number " << first << " at (" << place << ") m";
        return out.str();
      }
    };

    template <int dim>
    Point<dim> centre(const std::vector<Point<dim>> &vertices, const CellData<dim> &cell)
    {
      Point<dim> sum;
      for (const unsigned int v : cell.vertices)
        sum += vertices[v] / double(cell.vertices.size());
      return sum;
    }

    /// Smallest corner (1: right-angled, negative: inverted) and shortest over longest edge.
    template <int dim>
    std::pair<double, double> shape(const std::vector<Point<dim>> &vertices, const CellData<dim> &cell)
    {
      double corner = 1, shortest = 1e300, longest = 0;
      const Neighbours &others = neighbours(cell);
      for (unsigned int v = 0; v < cell.vertices.size(); ++v)
      {
        Tensor<2, dim> edges;
        double size = 1;
        for (unsigned int d = 0; d < dim; ++d)
        {
          edges[d] = vertices[cell.vertices[others[v][d]]] - vertices[cell.vertices[v]];
          const double length = edges[d].norm();
          size *= length;
          shortest = std::min(shortest, length);
          longest = std::max(longest, length);
        }
        corner = std::min(corner, size > 0 ? determinant(edges) / size : 0.);
      }
      return {corner, longest > 0 ? shortest / longest : 0.};
    }

    using FaceVertices = std::vector<unsigned int>;

    /// The cells of each face, by its sorted vertices.
    template <int dim>
    std::map<FaceVertices, std::vector<unsigned int>> faces(const std::vector<CellData<dim>> &cells)
    {
      std::map<FaceVertices, std::vector<unsigned int>> result;
      for (unsigned int c = 0; c < cells.size(); ++c)
      {
        const ReferenceCell type = shape_of(cells[c]);
        for (const unsigned int f : type.face_indices())
        {
          FaceVertices face;
          for (unsigned int v = 0; v < type.face_reference_cell(f).n_vertices(); ++v)
            face.push_back(cells[c].vertices[type.face_to_cell_vertices(f, v, 1)]);
          std::sort(face.begin(), face.end());
          result[face].push_back(c);
        }
      }
      return result;
    }

    template <int dim>
    void check_joined(const std::vector<Point<dim>> &vertices, const std::vector<CellData<dim>> &cells,
                      const std::string &file, const std::vector<std::vector<FaceVertices>> &glued,
                      const std::string &way_out)
    {
      std::vector<unsigned int> piece(cells.size());
      std::iota(piece.begin(), piece.end(), 0u);
      const auto root = [&](unsigned int c)
      {
        while (piece[c] != c)
          c = piece[c] = piece[piece[c]];
        return c;
      };
      Fault<dim> overlapping;
      const auto cells_of = faces(cells);
      for (const auto &[face, own] : cells_of)
      {
        if (own.size() > 2)
          overlapping.add(own[2], cells[own[2]], centre(vertices, cells[own[2]]));
        for (const unsigned int c : own)
          piece[root(c)] = root(own[0]);
      }
      if (overlapping.n > 0)
        throw InputError("The mesh file " + file + " has " + overlapping.text("overlapping") +
                         ": more than two cells share a face; remove what is there twice.");
      for (const std::vector<FaceVertices> &list : glued)
      {
        unsigned int first = numbers::invalid_unsigned_int;
        for (FaceVertices face : list)
        {
          std::sort(face.begin(), face.end());
          const auto behind = cells_of.find(face);
          if (behind == cells_of.end())
            continue;
          if (first == numbers::invalid_unsigned_int)
            first = behind->second[0];
          piece[root(behind->second[0])] = root(first);
        }
      }
      std::map<unsigned int, std::vector<unsigned int>> pieces;
      for (unsigned int c = 0; c < cells.size(); ++c)
        pieces[root(c)].push_back(c);
      if (pieces.size() == 1)
        return;
      const auto smallest =
          std::min_element(pieces.begin(), pieces.end(),
                           [](const auto &a, const auto &b) { return a.second.size() < b.second.size(); });
      std::ostringstream text;
      text << "The mesh file " << file << " falls into " << pieces.size()
           << " pieces that share no face, the smallest of " << smallest->second.size() << " cells at ("
           << centre(vertices, cells[smallest->second.front()])
           << ") m: a body is of one piece; join them in gmsh (BooleanFragments before meshing, "
              "Coherence Mesh after it)"
           << way_out << " or remove what does not belong.";
      throw InputError(text.str());
    }
  } // namespace

  template <int dim>
  void check_cells(const std::vector<Point<dim>> &vertices, const std::vector<CellData<dim>> &cells,
                   const std::string &file, const std::vector<std::vector<FaceVertices>> &glued,
                   const std::string &way_out)
  {
    Fault<dim> bad, slivers, poor;
    for (unsigned int c = 0; c < cells.size(); ++c)
    {
      const auto [corner, edge] = shape(vertices, cells[c]);
      if (!(corner > degenerate_corner))
        bad.add(c, cells[c], vertices[cells[c].vertices[0]]);
      else if (corner < sliver_corner || edge < sliver_edge)
        slivers.add(c, cells[c], centre(vertices, cells[c]));
      else if (corner < poor_corner || edge < poor_edge)
        poor.add(c, cells[c], centre(vertices, cells[c]));
    }
    if (bad.n > 0)
      throw InputError("The mesh file " + file + " has " + bad.text("inverted or degenerate") +
                       "; repair the mesh (gmsh: Tools/Statistics, Mesh.Optimize, ReorientMesh).");
    if (slivers.n > 0)
      throw InputError("The mesh file " + file + " has " + slivers.text("sliver") +
                       ": an edge below 1e-4 of the cell's longest or a corner nearly flat; repair the mesh "
                       "(gmsh: Tools/Statistics, Mesh.Optimize, merge nearly equal points).");
    if (poor.n > 0)
      run_log().line("The mesh file " + file + " has " + poor.text("very thin") +
                     ": expect larger errors and longer times there.");
    check_joined(vertices, cells, file, glued, way_out);
  }

  template <int dim>
  void check_number_of_cells(const double n_cells, const unsigned int degree, const std::string &body,
                             const std::string &advice)
  {
    const double n_unknowns = dim * std::pow(degree, dim) * n_cells;
    if (n_unknowns <= most_unknowns)
      return;
    std::ostringstream text;
    text.precision(2);
    text << "The mesh of body " << body << " would have " << n_cells << " cells and " << n_unknowns
         << " unknowns, more than the " << most_unknowns << " that can be factorised: " << advice << ".";
    throw InputError(text.str());
  }

  template void check_cells(const std::vector<Point<2>> &, const std::vector<CellData<2>> &,
                            const std::string &, const std::vector<std::vector<FaceVertices>> &,
                            const std::string &);
  template void check_cells(const std::vector<Point<3>> &, const std::vector<CellData<3>> &,
                            const std::string &, const std::vector<std::vector<FaceVertices>> &,
                            const std::string &);
  template void check_number_of_cells<2>(double, unsigned int, const std::string &, const std::string &);
  template void check_number_of_cells<3>(double, unsigned int, const std::string &, const std::string &);
} // namespace vibrocontact
