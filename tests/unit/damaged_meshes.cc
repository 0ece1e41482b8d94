// Mesh files that are refused with a sentence: what is wrong, how many, where, what to do.

#include "box_of_cells.h"
#include "scratch_folder.h"

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/scene/file_cells.h>
#include <vibrocontact/scene/mesh_file.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

using namespace vibrocontact;
using namespace dealii;

namespace
{
  std::string damaged_mesh(const std::string &name)
  {
    return scratch_folder() + "/" + name;
  }

  std::string deck_with(std::string text, const std::string &from, const std::string &to)
  {
    const auto place = text.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    return place == std::string::npos ? text : text.replace(place, from.size(), to);
  }

  std::string deck_of_box(
      const std::string &type, const std::string &more = "",
      const std::function<Point<3>(const Point<3> &)> &place = [](const Point<3> &p) { return p; })
  {
    BoxOfCells result;
    result.type = type;
    result.divisions = {{2, 1, 1}};
    result.place = place;
    result.more = more;
    return result.text();
  }

  /// What the program says to a mesh of this text, with the entries as they are.
  std::string said_of_mesh(const std::string &text, const std::string &ending = ".inp",
                           MeshFileParameters parameters = {})
  {
    parameters.file = damaged_mesh("mesh" + ending);
    if (parameters.held_groups.empty())
      parameters.held_groups = {"left"};
    std::ofstream(parameters.file, std::ios::binary) << text;
    try
    {
      ElasticModel<3> model;
      add_supports(model, parameters, make_mesh_from_file(parameters, 0, nullptr, "part", MPI_COMM_WORLD));
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "nothing";
  }

  void expect_in(const std::string &said, const std::vector<std::string> &parts)
  {
    for (const std::string &part : parts)
      EXPECT_NE(said.find(part), std::string::npos) << "wanted: " << part << "\ngot: " << said;
    EXPECT_LT(said.size(), 700u) << said;
  }
} // namespace

TEST(DamagedMeshes, good_ones_are_taken)
{
  for (const char *type : {"C3D4", "C3D6", "C3D8", "C3D10", "C3D15", "C3D20"})
    EXPECT_EQ(said_of_mesh(deck_of_box(type)), "nothing") << type;
}

TEST(DamagedMeshes, setsOfSurfacesAloneAreNoGroupsOfCells)
{
  const std::string good = deck_of_box("C3D8"),
                    sets = "*ELSET, ELSET=pad_1, INTERNAL\n1\n*ELSET, ELSET=pad_2\n2\n",
                    surface = "*SURFACE, NAME=pad\npad_1, S1\npad_2, S1\n";
  expect_in(said_of_mesh(good + sets), {"has groups of cells", "pad_1"});
  EXPECT_EQ(said_of_mesh(good + sets + surface), "nothing");
  // a section makes one a group of cells
  expect_in(said_of_mesh(good + sets + surface + "*SOLID SECTION, ELSET=pad_1, MATERIAL=steel\n"),
            {"has groups of cells", "pad_1"});
}

TEST(DamagedMeshes, decks)
{
  const std::string good = deck_of_box("C3D4");
  expect_in(said_of_mesh(deck_with(good, "TYPE=C3D4", "TYPE=C3D27")),
            {"line", "solid elements of type C3D27", "C3D10"});
  expect_in(said_of_mesh(deck_with(good, "TYPE=C3D4", "TYPE=C3D10")),
            {"line", "C3D10 with", "nodes instead of 10"});
  expect_in(said_of_mesh(deck_with(good, "TYPE=C3D4", "TYPE=S4")), {"no solid cells", "12 quadrilaterals"});
  expect_in(said_of_mesh(deck_with(good, "TYPE=C3D4", "TYPE=B31")), {"no solid cells", "only 12 nodes"});
  expect_in(said_of_mesh("*NODE\n1, 0, 0, 0\n*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n"),
            {"line 4", "node 2, which is not given"});
  expect_in(said_of_mesh("*NODE\n1, 0, zero, 0\n"), {"line 2", "\"zero\" where a coordinate"});
  expect_in(said_of_mesh("*NODE\n1, 0, 0, 0\n1, 1, 0, 0\n"), {"line 3", "node 1 a second time"});
  expect_in(said_of_mesh("*NODE\n-1, 0, 0, 0\n"), {"line 2", "\"-1\" where the number"});
  expect_in(said_of_mesh("*INCLUDE, INPUT=mesh.txt\n"), {"line 1", "includes another file"});
  expect_in(said_of_mesh(good + "*SURFACE, NAME=pad\nmissing, S1\n"), {"surface pad of the set missing"});
  expect_in(said_of_mesh(good + "*SURFACE, NAME=pad\n1, S5\n"), {"face \"S5\"", "tetrahedra do not have"});
  expect_in(said_of_mesh(good + "*NSET, NSET=more\nnone\n"), {"names the set none"});
  expect_in(said_of_mesh(""), {"no solid cells and no nodes"});
}

TEST(DamagedMeshes, cells)
{
  const std::string good = deck_of_box("C3D4");
  // mixed cells, the way out
  expect_in(said_of_mesh(good + "*ELEMENT, TYPE=C3D8\n99, 1, 2, 3, 4, 5, 6, 7, 8\n"),
            {"mixes 12 tetrahedra (12 in \"body\"), 1 hexahedra (1 in no group)", "one type",
             "tetrahedra alone", "Mesh/Split into tetrahedra"});
  expect_in(
      said_of_mesh(
          good +
          "*NODE\n101, 0, 0, 5\n102, 1, 0, 5\n103, 0, 1, 5\n104, 0, 0, 6\n105, .5, 0, 5\n106, .5, .5, 5\n"
          "107, 0, .5, 5\n108, 0, 0, 5.5\n109, .5, 0, 5.5\n110, 0, .5, 5.5\n*ELEMENT, TYPE=C3D10\n"
          "99, 101, 102, 103, 104, 105, 106, 107, 108, 109, 110\n"),
      {"mixes", "second-order tetrahedra", "Mesh.ElementOrder"});
  for (const std::string type : {"C3D4", "C3D6", "C3D8"})
  {
    const std::string kind = type == "C3D4" ? "tetrahedra" : type == "C3D6" ? "prisms" : "hexahedra";
    expect_in(
        said_of_mesh(deck_of_box(type, "", [](const Point<3> &p) { return Point<3>(p[0], p[1], -p[2]); })),
        {"inverted or degenerate " + kind, "number 1"});
    expect_in(said_of_mesh(
                  deck_of_box(type, "", [](const Point<3> &p) { return Point<3>(p[0], p[1], 1e-5 * p[2]); })),
              {"sliver " + kind});
  }
  // two boxes that only touch: their nodes are there twice
  const std::string tail =
      "*NODE\n101, 1, 0, 0\n102, 2, 0, 0\n103, 1, 1, 0\n104, 1, 0, 1\n*ELEMENT, TYPE=C3D4, ELSET=body\n"
      "99, 101, 102, 103, 104\n";
  expect_in(said_of_mesh(good + tail), {"3 double nodes", "crack"});
  expect_in(said_of_mesh(
                good + deck_with(deck_with(deck_with(deck_with(tail, "101, 1", "101, 3"), "102, 2", "102, 4"),
                                           "103, 1", "103, 3"),
                                 "104, 1", "104, 3")),
            {"falls into 2 pieces", "smallest of 1 cells"});
  expect_in(said_of_mesh(good + "*ELEMENT, TYPE=C3D4, ELSET=body\n99, 1, 2, 3, 4\n"),
            {"overlapping tetrahedra", "share a face"});
}

TEST(DamagedMeshes, middle_nodes)
{
  // the first middle node of the first cell moved far off, inside out, and given twice
  BoxOfCells wild;
  wild.type = "C3D10";
  wild.divisions = {{2, 1, 1}};
  const std::string good = wild.text();
  const auto middle = good.find("\n5, ");
  ASSERT_NE(middle, std::string::npos);
  const std::string line = good.substr(middle + 1, good.find('\n', middle + 1) - middle - 1);
  expect_in(said_of_mesh(deck_with(good, line, "5, 9, 9, 9")),
            {"middle nodes of cells further than 0.3", "(9 9 9)"});
  // a middle node of the first cell has a double beside it in the second one
  wild.write(damaged_mesh("torn.inp"));
  FileMesh torn = read_inp(damaged_mesh("torn.inp"));
  std::vector<unsigned int> &nodes = std::find_if(torn.elements.begin(), torn.elements.end(),
                                                  [](const FileElements &block) { return block.type == 11; })
                                         ->nodes;
  const auto shared =
      std::find_first_of(nodes.begin() + 14, nodes.begin() + 20, nodes.begin() + 4, nodes.begin() + 10);
  ASSERT_NE(shared, nodes.begin() + 20);
  torn.nodes.push_back(torn.nodes[*shared] + Tensor<1, 3>({0.05, 0, 0}));
  *shared = torn.nodes.size() - 1;
  try
  {
    solid_cells(torn, "torn.inp");
    FAIL();
  }
  catch (const InputError &error)
  {
    expect_in(error.what(), {"hanging middle nodes, the first at", "different ones"});
  }
  // curved inside out: a middle node a quarter of its edge off turns a flat cell over
  BoxOfCells flat = wild;
  flat.divisions = {{1, 1, 1}};
  flat.curved = true;
  flat.place = [](const Point<3> &p)
  {
    return Point<3>(p[0], p[1],
                    0.2 * p[2] + 0.25 * std::sin(numbers::PI * p[0]) * (p[2] == 0 && p[1] == 0 ? 1 : 0));
  };
  for (const char *type : {"C3D10", "C3D15", "C3D20"})
  {
    flat.type = type;
    expect_in(said_of_mesh(flat.text()), {"curved cells that are inverted in places", "first-order"});
  }
}

TEST(DamagedMeshes, groups_and_units)
{
  const std::string good = deck_of_box("C3D10");
  MeshFileParameters parameters;
  parameters.held_groups = {"leftt"};
  expect_in(said_of_mesh(good, ".inp", parameters), {"no faces in a group named 'leftt'", "left (2 faces)"});
  parameters.held_groups = {"left", "all"};
  expect_in(said_of_mesh(good, ".inp", parameters), {"belong to \"", "\"left\"", "\"all\""});
  parameters.held_groups = {"left"};
  parameters.unit = 1e-6;
  expect_in(said_of_mesh(good, ".inp", parameters), {"describes a body of", "Set Unit"});
  parameters.unit = 40;
  expect_in(said_of_mesh(good, ".inp", parameters), {"mass of", "kg with Unit = 40", "density"});
  parameters.unit = 1;
  parameters.element_degree = 3;
  expect_in(said_of_mesh(good, ".inp", parameters),
            {"Element degree is 3", "second-order tetrahedra", "Element degree = 2"});
  parameters.element_degree = 2;
  parameters.geometry = "wheel";
  expect_in(said_of_mesh(good, ".inp", parameters), {"Geometry is wheel", "Geometry = flat"});
  parameters.geometry = "flat";
  // an inner face by two shells
  expect_in(said_of_mesh(deck_of_box(
                "C3D8", "*NSET, NSET=more\n1,\n*ELEMENT, TYPE=S4, ELSET=inner\n98, 2, 3, 7, 6\n")),
            {"1 faces of named groups, the first of \"inner\"", "no faces of the boundary"});
  // refinement asked of tetrahedra
  parameters.contact_group = "top";
  parameters.contact_point = {0.5, 0.5, 1};
  parameters.file = damaged_mesh("tetrahedra.inp");
  std::ofstream(parameters.file) << deck_of_box("C3D10");
  ContactGrid grid;
  grid.n_x = grid.n_y = 2;
  grid.spacing_x = grid.spacing_y = 0.1;
  grid.x_first = grid.y_first = -0.05;
  try
  {
    make_mesh_from_file(parameters, 0, &grid, "part", MPI_COMM_WORLD);
    FAIL();
  }
  catch (const InputError &error)
  {
    expect_in(error.what(), {"Contact cell size", "not refined here", "size field", "Contact cell size = 0"});
  }
}

TEST(DamagedMeshes, files_of_gmsh)
{
  expect_in(said_of_mesh("SystemCall \"touch started\";\n", ".msh"), {"no $MeshFormat at its beginning"});
  expect_in(said_of_mesh("hello\n", ".unv"), {"no -1"});
  expect_in(said_of_mesh("hello\n", ".vtk"), {"# vtk DataFile"});
  expect_in(said_of_mesh("GRID, 1\nCTETRA\n", ".bdf"), {"mesh.bdf"});
  expect_in(said_of_mesh("HDF", ".med"), {"MED", "UNV"});
  expect_in(said_of_mesh("solid", ".stl"), {"ending \".stl\"", ".msh"});
  const std::string head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  expect_in(
      said_of_mesh(head + "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n$Elements\n1\n1 4 2 1 1 "
                          "1 2 3 9\n$EndElements\n",
                   ".msh"),
      {"mesh.msh"});
  expect_in(
      said_of_mesh(head + "$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n$EndNodes\n$Elements\n1\n"
                          "1 7 2 1 1 1 2 3 4 5\n$EndElements\n",
                   ".msh"),
      {"1 pyramids", "no body is made", "Mesh/Split into tetrahedra"});
  expect_in(said_of_mesh(head + "$Nodes\n1\n1 nan 0 0\n$EndNodes\n", ".msh"), {"mesh.msh"});
  // what crashes gmsh itself: it reads in a process of its own
  expect_in(
      said_of_mesh(
          "    -1\n  2411\n         1         1         1        11\n 0. 0. 0.\n    -1\n    -1\n  2412\n"
          "         1       118         1         1         7        10\n         1         2\n    -1\n",
          ".unv"),
      {"mesh.unv"});
  EXPECT_FALSE(std::filesystem::exists("started"));
}
