#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/fe/second_order_system.h>
#include <vibrocontact/matrices/dmig.h>
#include <vibrocontact/matrices/matrix_market.h>
#include <vibrocontact/scene/body.h>
#include <vibrocontact/scene/matrices.h>
#include <vibrocontact/scene/nastran_cards.h>

#include <gtest/gtest.h>

using namespace vibrocontact;

namespace
{
  std::string matrix_file(const std::string &name)
  {
    return std::string(TESTS_DIRECTORY) + "/errors/matrices/" + name;
  }

  /// A part of two nodes on springs, by good files.
  MatricesParameters matrix_part()
  {
    MatricesParameters part;
    part.stiffness = matrix_file("K.mtx");
    part.mass = matrix_file("M.mtx");
    part.dofs = matrix_file("dofs.csv");
    return part;
  }

  MatricesParameters part_by_cards()
  {
    MatricesParameters part;
    part.stiffness = part.mass = matrix_file("good.pch");
    part.nodes = matrix_file("one.inp");
    return part;
  }

  /// What the check or the assembly of a part says.
  std::string refusal_of(const MatricesParameters &part)
  {
    try
    {
      part.check("part/Matrices");
      part.assemble(body_of("part", "matrices", part), true, nullptr, MPI_COMM_SELF);
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "";
  }

  void expect_refusal_of(const MatricesParameters &part, const std::string &expected)
  {
    EXPECT_NE(refusal_of(part).find(expected), std::string::npos) << expected << "\n" << refusal_of(part);
  }
} // namespace

TEST(MatrixFiles, DamagedOnesAreRefused)
{
  EXPECT_EQ(refusal_of(matrix_part()), "");
  EXPECT_EQ(refusal_of(part_by_cards()), "");
  MatricesParameters own = matrix_part();
  own.mass = matrix_file("negative_mass.mtx");
  expect_refusal_of(own, "negative_mass.mtx, line 5, has -0.1 on the diagonal");
  own = matrix_part();
  own.stiffness = matrix_file("complex.mtx");
  expect_refusal_of(own, "complex.mtx, line 1, says 'coordinate complex symmetric'");
  own.stiffness = matrix_file("no_such.mtx");
  expect_refusal_of(own, "Stiffness: the file");
  own.stiffness = "";
  expect_refusal_of(own, "part/Matrices/Stiffness is empty");
  own = matrix_part();
  own.dofs = matrix_file("dof_twice.csv");
  expect_refusal_of(own, "dof_twice.csv, line 7, gives y of node 2 a second time");
  own.dofs = matrix_file("direction.csv");
  expect_refusal_of(own, "direction.csv, line 7, has the direction 'w'");
  own.dofs = "";
  expect_refusal_of(own, "part/Matrices/Dofs is empty");
  own = matrix_part();
  own.nodes = matrix_file("one.inp");
  expect_refusal_of(own, "Nodes is given, but the table of Dofs says");
  own = matrix_part();
  own.translations = matrix_file("T.mtx");
  expect_refusal_of(own, "Translations is given without Recovery");

  own = part_by_cards();
  own.stiffness = matrix_file("complex.pch");
  expect_refusal_of(own, "complex.pch, line 1, gives KAAX the type 3");
  own.stiffness = matrix_file("number.pch");
  expect_refusal_of(own, "number.pch, line 4, has '1e6x' where a finite number is due");
  own = part_by_cards();
  own.mass = matrix_file("cut.pch");
  expect_refusal_of(own, "cut.pch, line 8, gives a column of MAAX without entries");
  own = part_by_cards();
  own.matrix_names[0] = "KGG";
  expect_refusal_of(own, "good.pch has no matrix KGG but KAAX, MAAX");
  own = part_by_cards();
  own.nodes = matrix_file("system.bdf");
  expect_refusal_of(own, "system.bdf, line 1, gives node 1 in coordinate system 3");
  own.nodes = matrix_file("other.inp");
  expect_refusal_of(own, "other.inp does not say where node 1 is");
}

TEST(MatrixFiles, UnfitGroupsAreRefused)
{
  MatricesParameters own = matrix_part();
  own.held_groups = {"below"};
  expect_refusal_of(own, "names the group 'below', but there is no table of Groups");
  own.groups = matrix_file("groups.csv");
  own.contact_group = "below";
  expect_refusal_of(own, "contains the contact group 'below'");
  own.held_groups.clear();
  own.contact_point = {0, 0, 0.5};
  expect_refusal_of(own, "lies -0.5 m above the Contact point");
  own.contact_group = "";
  own.recovery = matrix_file("T.mtx");
  own.held_groups = {"above"};
  expect_refusal_of(own, "Held groups is given beside Recovery");
  own = matrix_part();
  own.dofs = matrix_file("steps.csv");
  own.groups = matrix_file("three.csv");
  own.contact_group = "below";
  expect_refusal_of(own, "lies on no plane z = 0");
}

TEST(MatrixFiles, GridOfNodesTakesThemInAnyOrder)
{
  const NodePlaces places = {{7, {0.01, 0.02, 1e-4}}, {3, {0, 0, 0}}, {9, {0.01, 0, 0}}, {4, {0, 0.02, 0}}};
  const NodeGrid found = node_grid("pad", {7, 3, 9, 4}, places, 1);
  EXPECT_EQ(found.grid.n_x, 2u);
  EXPECT_EQ(found.grid.n_y, 2u);
  EXPECT_DOUBLE_EQ(found.grid.spacing_x, 0.01);
  EXPECT_DOUBLE_EQ(found.grid.spacing_y, 0.02);
  EXPECT_EQ(found.nodes, (std::vector<unsigned long>{3, 9, 4, 7}));
  EXPECT_DOUBLE_EQ(found.height[3], 1e-4);
  // a single node has the cell that it is given
  EXPECT_DOUBLE_EQ(node_grid("pad", {3}, places, 0.5).grid.spacing_x, 0.5);
  EXPECT_THROW(node_grid("pad", {7, 3, 9}, places, 1), InputError);
  EXPECT_THROW(node_grid("pad", {7, 3, 9, 9}, places, 1), InputError);
}

TEST(MatrixFiles, TextIsReadAsItWasWritten)
{
  DenseMatrix A(3, 3);
  A(0, 0) = 1. / 3;
  A(1, 1) = 2;
  A(2, 2) = 1e-300;
  A(2, 0) = A(0, 2) = -0.1;
  for (const bool symmetric : {true, false})
  {
    const DenseMatrix B = read_dense_matrix_market("A.mtx", matrix_market_text(A, symmetric, "of a test"));
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        EXPECT_EQ(A(i, j), B(i, j)) << i << " " << j;
  }
}

TEST(MatrixFiles, FieldsOfCards)
{
  const auto wide = [](const std::string &word, const unsigned int width)
  { return std::string(width - word.size(), ' ') + word; };
  std::string text = "$ a comment\nGRID    ";
  for (const char *const word : {"1", "", ".5", "1.-2", "2.D1"})
    text += wide(word, 8);
  text += "\nFORCE,1\nGRID*   ";
  for (const char *const word : {"2", "", ".5", "-1.5"})
    text += wide(word, 16);
  text += "\n*       " + wide("3.0E+00", 16) + "\ngrid,3,,1.,\n,,7\n";
  std::vector<NastranCard> cards;
  for_each_card("cards.bdf", text, {"GRID"}, [&](const NastranCard &card) { cards.push_back(card); });
  ASSERT_EQ(cards.size(), 3u);
  EXPECT_EQ(cards[0].count(0), 1u);
  EXPECT_EQ(cards[0].number(2), 0.5);
  EXPECT_EQ(cards[0].number(3), 1e-2);
  EXPECT_EQ(cards[0].number(4), 20.);
  EXPECT_EQ(cards[1].number(3), -1.5);
  EXPECT_EQ(cards[1].number(4), 3.);
  EXPECT_EQ(cards[2].field(9), "7");
  EXPECT_THROW(cards[2].number(3), InputError);
}
