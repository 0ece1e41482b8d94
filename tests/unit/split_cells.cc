// Hexahedra, prisms and pyramids of files split into tetrahedra: every numbering of the vertices, neighbours that agree, mixed cells as
// one mesh (constant strain), the place of new middle nodes, the volume of curved cells, what is refused.

#include "box_of_cells.h"
#include "constant_strain.h"
#include "scratch_folder.h"

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/fe/assemble_body.h>
#include <vibrocontact/scene/cell_elements.h>
#include <vibrocontact/scene/file_cells.h>
#include <vibrocontact/scene/mesh_file.h>
#include <vibrocontact/scene/split_cells.h>

#include <gmsh.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

using namespace vibrocontact;
using namespace dealii;

namespace
{
  /// Six times the volume of the tetrahedron of these nodes.
  double volume_of_corners(const FileMesh &mesh, const unsigned int *const nodes)
  {
    const Tensor<1, 3> a = mesh.nodes[nodes[1]] - mesh.nodes[nodes[0]],
                       b = mesh.nodes[nodes[2]] - mesh.nodes[nodes[0]],
                       c = mesh.nodes[nodes[3]] - mesh.nodes[nodes[0]];
    return cross_product_3d(a, b) * c;
  }

  const std::vector<Point<3>> cube_corners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                              {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

  std::string said_of_split(const MeshFileParameters &parameters)
  {
    try
    {
      make_mesh_from_file(parameters, 0, nullptr, "part", MPI_COMM_SELF);
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "nothing";
  }

  /// The unit cube of n x n x n cubes as gmsh's format 2.2: hexahedra, and every second cube as six pyramids about its middle, of which
  /// those on the boundary are two tetrahedra.
  std::string cubes_with_pyramids(const unsigned int n, const bool quadratic,
                                  const std::function<Point<3>(const Point<3> &)> &place)
  {
    using Index = std::array<unsigned int, 3>;
    std::map<Index, unsigned int> number;
    std::ostringstream nodes, elements;
    nodes.precision(17);
    unsigned int n_elements = 0;
    const auto node = [&](const Index &index)
    {
      const auto [found, is_new] = number.emplace(index, number.size() + 1);
      if (is_new)
      {
        Point<3> p;
        for (unsigned int d = 0; d < 3; ++d)
          p[d] = index[d] / (4. * n);
        nodes << found->second << " " << place(p) << "\n";
      }
      return found->second;
    };
    const auto add = [&](const unsigned int first_order, const unsigned int second_order,
                         const std::vector<Index> &corners)
    {
      const unsigned int type = quadratic ? second_order : first_order;
      elements << ++n_elements << " " << type << " 2 1 1";
      for (const Index &corner : corners)
        elements << " " << node(corner);
      if (quadratic)
        for (const auto &ends : middles(type))
        {
          const Index &a = corners[ends[0]], &b = corners[ends[1]];
          elements << " " << node({{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2}});
        }
      elements << "\n";
    };
    const unsigned int faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                      {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
        {
          std::vector<Index> corners;
          for (const Point<3> &p : cube_corners)
            corners.push_back({{4 * (i + (p[0] > 0)), 4 * (j + (p[1] > 0)), 4 * (k + (p[2] > 0))}});
          if ((i + j + k) % 2 == 0)
          {
            add(5, 17, corners);
            continue;
          }
          const Index middle = {{4 * i + 2, 4 * j + 2, 4 * k + 2}};
          for (const auto &face : faces)
          {
            // seen from the middle
            const Index a = corners[face[0]], b = corners[face[3]], c = corners[face[2]],
                        d = corners[face[1]];
            unsigned int on_boundary = 0;
            for (unsigned int e = 0; e < 3; ++e)
              on_boundary += a[e] == b[e] && b[e] == c[e] && (a[e] == 0 || a[e] == 4 * n);
            if (on_boundary > 0)
            {
              add(4, 11, {a, b, c, middle});
              add(4, 11, {a, c, d, middle});
            }
            else
              add(7, 19, {a, b, c, d, middle});
          }
        }
    std::ostringstream text;
    text << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n"
         << number.size() << "\n"
         << nodes.str() << "$EndNodes\n$Elements\n"
         << n_elements << "\n"
         << elements.str() << "$EndElements\n";
    return text.str();
  }

  double volume_of_split(const BoxOfCells &box)
  {
    MeshFileParameters parameters;
    parameters.file = scratch_folder() + "/volume.inp";
    parameters.split = true;
    box.write(parameters.file);
    const BodyMesh<3> mesh = make_mesh_from_file(parameters, 0, nullptr, "part", MPI_COMM_SELF);
    const auto mapping = make_mapping(mesh);
    const auto element = scalar_element<3>(mesh.reference_cell(), 2);
    FEValues<3> values(*mapping, *element, cell_quadrature<3>(mesh.reference_cell(), 3), update_JxW_values);
    double volume = 0;
    for (const auto &cell : mesh.triangulation->active_cell_iterators())
    {
      values.reinit(cell);
      for (const unsigned int q : values.quadrature_point_indices())
        volume += values.JxW(q);
    }
    return volume;
  }
} // namespace

TEST(SplitCells, every_numbering_fills_the_cell)
{
  struct Solid
  {
    unsigned int type;
    double volume;
    std::vector<Point<3>> corners;
    std::set<std::size_t> n_tetrahedra;
  };
  const std::vector<Point<3>> &c = cube_corners;
  for (const Solid &solid : std::vector<Solid>{{4, 1 / 6., {c[0], c[1], c[3], c[4]}, {1}},
                                               {5, 1, c, {5, 6}},
                                               {6, 0.5, {c[0], c[1], c[3], c[4], c[5], c[7]}, {3}},
                                               {7, 1 / 3., {c[0], c[1], c[2], c[3], c[4]}, {2}}})
  {
    std::vector<unsigned int> numbering(solid.corners.size());
    std::iota(numbering.begin(), numbering.end(), 0);
    std::set<std::size_t> seen;
    do
    {
      FileMesh mesh;
      mesh.nodes.resize(numbering.size());
      for (unsigned int v = 0; v < numbering.size(); ++v)
        mesh.nodes[numbering[v]] = solid.corners[v];
      mesh.elements = {{solid.type, {3}, numbering}};
      const FileMesh split = split_into_tetrahedra(mesh, "solid");
      ASSERT_EQ(split.elements.size(), 1u);
      const FileElements &block = split.elements[0];
      ASSERT_EQ(block.type, 4u);
      ASSERT_EQ(block.groups, std::vector<unsigned int>{3});
      double sum = 0;
      for (std::size_t k = 0; k < block.nodes.size(); k += 4)
      {
        const double volume = volume_of_corners(split, &block.nodes[k]) / 6;
        ASSERT_GT(volume, 0.16 * std::min(1., solid.volume));
        sum += volume;
      }
      ASSERT_NEAR(sum, solid.volume, 1e-14);
      seen.insert(block.nodes.size() / 4);
    } while (std::next_permutation(numbering.begin(), numbering.end()));
    EXPECT_EQ(seen, solid.n_tetrahedra) << solid.type;
  }
}

TEST(SplitCells, middle_nodes_of_every_type_are_where_gmsh_has_them)
{
  gmsh::initialize(0, nullptr, false);
  for (const unsigned int type : {11, 12, 13, 14, 17, 18, 19})
  {
    std::string name;
    int dim, order, n_nodes, n_corners;
    std::vector<double> places;
    gmsh::model::mesh::getElementProperties(type, name, dim, order, n_nodes, places, n_corners);
    const auto lists = middles(type);
    ASSERT_EQ(lists.size(), std::size_t(n_nodes - n_corners)) << name;
    for (unsigned int m = 0; m < lists.size(); ++m)
      for (unsigned int d = 0; d < 3; ++d)
      {
        double mean = 0;
        for (const unsigned int corner : lists[m])
          mean += places[3 * corner + d] / lists[m].size();
        EXPECT_NEAR(places[3 * (n_corners + m) + d], mean, 1e-14) << name << ", node " << n_corners + m;
      }
  }
  gmsh::finalize();
}

namespace
{
  /// The same mesh, its nodes numbered in another order.
  FileMesh renumbered(const FileMesh &mesh, std::mt19937 &random)
  {
    std::vector<unsigned int> order(mesh.nodes.size());
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), random);
    FileMesh result = mesh;
    for (unsigned int k = 0; k < order.size(); ++k)
      result.nodes[order[k]] = mesh.nodes[k];
    for (FileElements &block : result.elements)
      for (unsigned int &node : block.nodes)
        node = order[node];
    return result;
  }

  /// How many tetrahedra each triangle belongs to.
  std::map<std::set<unsigned int>, unsigned int> cells_at_faces(const FileCells &cells)
  {
    std::map<std::set<unsigned int>, unsigned int> n_at;
    for (const CellData<3> &cell : cells.cells)
      for (const unsigned int left_out : cell.vertices)
      {
        std::set<unsigned int> face(cell.vertices.begin(), cell.vertices.end());
        face.erase(left_out);
        ++n_at[face];
      }
    return n_at;
  }

  FileMesh mixed_box(const std::string &type, const std::string &other)
  {
    BoxOfCells box;
    box.type = type;
    box.other_type = other;
    box.divisions = {{4, 3, 3}};
    box.write(scratch_folder() + "/agree.inp");
    return read_inp(scratch_folder() + "/agree.inp");
  }

  unsigned int n_boundary_triangles(const std::map<std::set<unsigned int>, unsigned int> &n_at)
  {
    unsigned int n_once = 0;
    for (const auto &[face, n] : n_at)
    {
      EXPECT_LE(n, 2u);
      n_once += n == 1;
    }
    return n_once;
  }
} // namespace

TEST(SplitCells, neighbours_agree_whatever_the_numbers)
{
  std::mt19937 random(3);
  for (const auto &[type, other] :
       std::vector<std::pair<std::string, std::string>>{{"C3D8", "C3D6"}, {"C3D20", "C3D15"}})
  {
    const FileMesh mesh = mixed_box(type, other);
    for (unsigned int round = 0; round < 20; ++round)
    {
      const FileCells cells = solid_cells(split_into_tetrahedra(renumbered(mesh, random), "box"), "box");
      EXPECT_EQ(cells.type, type == "C3D8" ? 4u : 11u);
      // the boundary and no more lies at one cell: two triangles of each square
      const auto n_at = cells_at_faces(cells);
      EXPECT_EQ(n_boundary_triangles(n_at), 132u);
      EXPECT_EQ(cells.face_counts().at("left"), 18u);
      for (const FileCells::Face &face : cells.faces)
        EXPECT_EQ(n_at.at(std::set<unsigned int>(face.corners.begin(), face.corners.end())), 1u);
      EXPECT_EQ(cells.groups.counts().at("body"), cells.cells.size());
    }
  }
}

TEST(SplitCells, triangles_on_quadrilaterals_fit_or_are_refused)
{
  std::mt19937 random(4);
  const FileMesh mesh = mixed_box("C3D8", "C3D4");
  const FileMesh as_it_is = split_into_tetrahedra(mesh, "box");
  EXPECT_EQ(n_boundary_triangles(cells_at_faces(solid_cells(as_it_is, "box"))), 132u);
  // of nine faces between them one or another is cut along the other diagonal
  for (unsigned int round = 0; round < 10; ++round)
    try
    {
      split_into_tetrahedra(renumbered(mesh, random), "box");
      ADD_FAILURE() << round;
    }
    catch (const InputError &error)
    {
      const std::string said = error.what();
      for (const char *part : {"The mesh file box has", "quadrilateral faces of cells on triangles",
                               "(0.5 0.", "other diagonal", "Mesh/Glued"})
        EXPECT_NE(said.find(part), std::string::npos) << said;
    }
}

TEST(SplitCells, cubes_that_gmsh_joins_by_pyramids)
{
  const std::string file = std::string(TESTS_DIRECTORY) + "/data/meshes/joined_by_pyramids.msh";
  std::map<unsigned int, unsigned int> n_of;
  for (const FileElements &block : read_file_mesh(file).elements)
    n_of[block.type] += block.nodes.size() / element_type(block.type)->n_nodes;
  // hexahedra of 27 nodes, pyramids of 14
  EXPECT_EQ(n_of[12], 8u);
  EXPECT_EQ(n_of[14], 4u);
  EXPECT_GT(n_of[11], 40u);
  EXPECT_THROW(FileCells::read(file), InputError);
  const FileCells cells = FileCells::read(file, true);
  EXPECT_EQ(cells.type, 11u);
  double volume = 0, area = 0;
  FileMesh places;
  places.nodes = cells.vertices;
  for (const CellData<3> &cell : cells.cells)
  {
    const double own = volume_of_corners(places, cell.vertices.data()) / 6;
    EXPECT_GT(own, 0);
    volume += own;
  }
  for (const auto &[face, n] : cells_at_faces(cells))
    if (n == 1)
    {
      const std::vector<unsigned int> v(face.begin(), face.end());
      area +=
          cross_product_3d(places.nodes[v[1]] - places.nodes[v[0]], places.nodes[v[2]] - places.nodes[v[0]])
              .norm() /
          2;
    }
  EXPECT_NEAR(volume, 2, 1e-12);
  // no face inside is left open
  EXPECT_NEAR(area, 10, 1e-12);
}

TEST(SplitCellsMpi, mixed_cells_are_one_mesh_of_constant_strain)
{
  double worst = 0;
  for (const auto &[type, other] : std::vector<std::pair<std::string, std::string>>{
           {"C3D8", "C3D6"}, {"C3D20", "C3D15"}, {"pyramids", ""}})
    for (const bool curved : {false, true})
      for (const unsigned int degree : {1u, 2u})
      {
        MeshFileParameters parameters;
        parameters.split = true;
        parameters.element_degree = degree;
        if (type == "pyramids")
        {
          parameters.file = scratch_folder() + "/pyramids.msh";
          std::ofstream(parameters.file) << cubes_with_pyramids(3, curved, distorted_in_box);
        }
        else
        {
          BoxOfCells box;
          box.type = type;
          box.other_type = other;
          box.divisions = {{4, 3, 3}};
          box.place = distorted_in_box;
          box.curved = curved;
          parameters.file = scratch_folder() + "/mixed.inp";
          box.write(parameters.file);
        }
        const ElasticBody<3> body(make_mesh_from_file(parameters, 0, nullptr, "box", MPI_COMM_WORLD), {},
                                  degree);
        const auto system = assemble_body(body);
        const ConstantStrain strain =
            constant_strain(body, *system, Tensor<2, 3>({{1, -2, -0.7}, {2, -2, 0.3}, {3, -2, 3.3}}));
        const double residual = strain.residual;
        EXPECT_GT(strain.n_inner, 20u);
        worst = std::max(worst, residual);
        const std::string what =
            type + ", degree " + std::to_string(degree) + (curved ? ", curved" : ", straight");
        EXPECT_LT(residual, 1e-12) << what;
        EXPECT_EQ(system->n_rigid_modes, 6u) << what;
        EXPECT_NEAR(system->total_mass / (body.model.material.density * 0.3 * 0.2 * 0.1), 1, 1e-12) << what;
      }
  std::cout << "forces on inner nodes over those on the boundary: " << worst << std::endl;
}

TEST(SplitCells, new_middle_nodes_lie_on_quadratic_and_near_other_surfaces)
{
  // shape functions of nodes on edges have every polynomial of second degree, by x, y, z: its volume is exact
  BoxOfCells box;
  box.type = "C3D20";
  box.other_type = "C3D15";
  box.divisions = {{2, 2, 2}};
  box.curved = true;
  box.place = [](const Point<3> &p)
  { return Point<3>(p[0] + 0.2 * p[1] * p[1] - 0.1 * p[1] * p[2], p[1] + 0.15 * p[2] * p[2], p[2]); };
  EXPECT_NEAR(volume_of_split(box), 1, 1e-13);
  box.place = [](const Point<3> &p)
  { return Point<3>(p[0] * (1 + 0.3 * p[1]), p[1], p[2] * (1 + 0.2 * p[1])); };
  EXPECT_NEAR(volume_of_split(box), 1 + 0.25 + 0.02, 1e-13);

  // a bent bar: the fourth order of the size, of cylinders
  std::vector<double> errors;
  for (const unsigned int n : {2, 4})
  {
    box.divisions = {{n, 2 * n, n}};
    box.place = [](const Point<3> &p)
    { return Point<3>((1 + p[0]) * std::cos(p[1]), (1 + p[0]) * std::sin(p[1]), p[2]); };
    errors.push_back(volume_of_split(box) / 1.5 - 1);
  }
  std::cout << "volume of the bent bar: " << errors[0] << ", " << errors[1] << std::endl;
  EXPECT_LT(std::abs(errors[1]), 1e-5);
  EXPECT_GT(std::log2(errors[0] / errors[1]), 3.5);
}

TEST(SplitCells, nodes_of_faces_and_middles_that_the_file_has_are_kept)
{
  // a hexahedron of 27 nodes beside one of 20: the face between them has one node, that of the file
  gmsh::initialize(0, nullptr, false);
  std::string name;
  int dim, order, n_nodes, n_corners;
  std::vector<double> places;
  gmsh::model::mesh::getElementProperties(12, name, dim, order, n_nodes, places, n_corners);
  gmsh::finalize();
  FileMesh mesh;
  std::map<std::array<int, 3>, unsigned int> number;
  for (const unsigned int cell : {0, 1})
  {
    FileElements block{cell == 0 ? 12u : 17u, {}, {}};
    for (unsigned int k = 0; k < element_type(block.type)->n_nodes; ++k)
    {
      const std::array<int, 3> index = {{int(std::lround(places[3 * k])) + 2 * int(cell),
                                         int(std::lround(places[3 * k + 1])),
                                         int(std::lround(places[3 * k + 2]))}};
      const auto [found, is_new] = number.emplace(index, mesh.nodes.size());
      if (is_new)
        mesh.nodes.emplace_back(index[0], index[1], index[2]);
      block.nodes.push_back(found->second);
    }
    mesh.elements.push_back(block);
  }
  // moved off the plane; the middle is kept where any face is curved
  mesh.nodes[number.at({{1, 0, 0}})] += Tensor<1, 3>({0.1, 0, 0});
  const std::size_t n_before = mesh.nodes.size();
  const FileMesh split = split_into_tetrahedra(mesh, "two");
  // five flat faces of each, and the middle of the second if it has a diagonal
  EXPECT_GE(split.nodes.size(), n_before + 10);
  EXPECT_LE(split.nodes.size(), n_before + 11);
  const FileCells cells = solid_cells(split, "two");
  unsigned int n_kept = 0;
  for (const auto &[around, place] : cells.mid_nodes)
    n_kept += place.distance(Point<3>(1.1, 0, 0)) < 1e-14;
  EXPECT_EQ(n_kept, 1u);
}

TEST(SplitCells, what_does_not_fit_is_refused)
{
  const auto expect_said = [](const std::string &said, const std::vector<std::string> &parts)
  {
    for (const std::string &part : parts)
      EXPECT_NE(said.find(part), std::string::npos) << "wanted: " << part << "\ngot: " << said;
    EXPECT_LT(said.size(), 700u) << said;
  };
  MeshFileParameters parameters;
  parameters.file = scratch_folder() + "/unfit.inp";
  BoxOfCells box;
  box.other_type = "C3D6";
  box.write(parameters.file);
  expect_said(said_of_split(parameters),
              {"mixes 4 hexahedra", "8 prisms", "Mesh/Split into tetrahedra to true"});
  parameters.split = true;
  EXPECT_EQ(said_of_split(parameters), "nothing");
  // first order beside second order
  box.type = "C3D8";
  box.other_type = "C3D15";
  box.write(parameters.file);
  expect_said(said_of_split(parameters), {"mixes", "one Mesh.ElementOrder"});
  // pyramids
  parameters.file = scratch_folder() + "/unfit.msh";
  std::ofstream(parameters.file) << cubes_with_pyramids(2, false, [](const Point<3> &p) { return p; });
  EXPECT_EQ(said_of_split(parameters), "nothing");
  parameters.split = false;
  expect_said(said_of_split(parameters), {"pyramids", "Mesh/Split into tetrahedra"});
  // a prism as a hexahedron of which two edges are one
  box.write(parameters.file = scratch_folder() + "/unfit.inp");
  parameters.split = true;
  std::ofstream(parameters.file, std::ios::app) << "*ELEMENT, TYPE=C3D8\n999, 1, 2, 3, 3, 5, 6, 7, 7\n";
  expect_said(said_of_split(parameters), {"1 cells with one node for two of their corners", "prisms"});
  // what is wrong with the cells is said of their tetrahedra
  parameters.split = true;
  parameters.file = scratch_folder() + "/unfit.inp";
  box.other_type = "C3D6";
  box.place = [](const Point<3> &p) { return Point<3>(p[0], p[1], -p[2]); };
  box.write(parameters.file);
  expect_said(said_of_split(parameters), {"inverted or degenerate tetrahedra"});
  box.place = [](const Point<3> &p) { return p; };
  box.write(parameters.file);
  parameters.geometry = "wheel";
  expect_said(said_of_split(parameters), {"Geometry is wheel", "holds tetrahedra", "Geometry = flat"});
}
