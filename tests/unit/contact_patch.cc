// Contact patch test: two blocks pressed together by a plane displacement carry a uniform pressure, with
// matching nodes exactly, with other nodes nearly; through the whole chain of elements, trace, compliance and
// contact solver. Of half-spaces, whose surface does not stay plane under uniform pressure, the undeformed
// gap is what Love's rectangle takes away.

#include "box_of_cells.h"
#include "scratch_folder.h"

#include <vibrocontact/contact/contact_solvers.h>
#include <vibrocontact/contact/half_space.h>
#include <vibrocontact/contact/interface.h>
#include <vibrocontact/fe/assemble_body.h>
#include <vibrocontact/fe/elastic_body.h>
#include <vibrocontact/reduction/flexibility.h>
#include <vibrocontact/scene/block.h>
#include <vibrocontact/scene/mesh_file.h>

#include <gtest/gtest.h>

#include <limits>

using namespace vibrocontact;
using namespace dealii;

namespace
{
  constexpr double width = 0.022, height = 0.01, young = 2e11;

  ContactGrid grid(const unsigned int n)
  {
    ContactGrid g;
    g.n_x = g.n_y = n;
    g.spacing_x = g.spacing_y = width / n;
    g.x_first = g.y_first = -width / 2 + width / n / 2;
    return g;
  }

  DenseMatrix compliance_of(BodyMesh<3> &&mesh, const std::string &held, const unsigned int degree,
                            const ContactGrid &g)
  {
    ElasticModel<3> model;
    model.material.young_modulus = young;
    model.material.poisson_ratio = 0;
    model.held = {mesh.boundary_id(held)};
    const ElasticBody<3> body(std::move(mesh), model, degree);
    const auto system = assemble_body(body, &g);
    Flexibility flexibility(*system);
    return flexibility.contact_compliance();
  }

  /// P_c K^-1 P_c^T of a block without lateral contraction, held on the face away from the contact.
  DenseMatrix compliance(const std::string &contact_face, const unsigned int divisions,
                         const unsigned int degree, const ContactGrid &g)
  {
    BlockParameters parameters;
    parameters.length = parameters.width = width;
    parameters.height = height;
    parameters.divisions_x = parameters.divisions_y = divisions;
    parameters.divisions_z = 2;
    parameters.contact_face = contact_face;
    return compliance_of(make_block<3>(parameters, "block", MPI_COMM_WORLD),
                         contact_face == "top" ? "bottom" : "top", degree, g);
  }

  /// Smallest and largest pressure over the one asked for when bodies of this compliance are pressed
  /// together over a gap by an approach; frictionless.
  std::pair<double, double> pressures(const std::shared_ptr<const ContactOperator> &A, const ContactGrid &g,
                                      const std::vector<double> &gap, const double approach,
                                      const double pressure, const std::string &name)
  {
    ContactInterface interface;
    interface.contacts.only() = g;
    interface.gap = gap;
    ContactParameters parameters;
    parameters.friction = 0;
    ContactProblem problem = rolling_problem(A, interface, creep_schemes().front(), Creepage(), parameters);
    problem.approach = approach;
    const ContactSolution solution = create_contact_solver(ContactSolverParameters())->solved(problem);
    EXPECT_TRUE(solution.converged);
    double low = 1e300, high = 0;
    for (unsigned int i = 0; i < g.n_points(); ++i)
    {
      low = std::min(low, solution.R(i) / g.cell_area() / pressure);
      high = std::max(high, solution.R(i) / g.cell_area() / pressure);
    }
    std::cout << name << ", " << g.n_x << " points: pressure " << low - 1 << " .. " << high - 1 << std::endl;
    return {low, high};
  }

  /// Two blocks of some divisions and degree.
  std::pair<double, double> blocks(const unsigned int upper, const unsigned int lower,
                                   const unsigned int degree, const ContactGrid &g)
  {
    DenseMatrix sum = compliance("bottom", upper, degree, g);
    sum.add(1., compliance("top", lower, degree, g));
    const double approach = 1e-6;
    return pressures(rolling_operator(g, std::move(sum), creep_schemes().front(), 1.), g,
                     std::vector<double>(g.n_points(), 0.), approach, young * approach / (2 * height),
                     std::to_string(upper) + " on " + std::to_string(lower) + " cells of degree " +
                         std::to_string(degree));
  }

  /// A block of cells from a file under the contact, or over it.
  DenseMatrix compliance_from_file(const std::string &type, const unsigned int divisions, const bool upper,
                                   const ContactGrid &g)
  {
    BoxOfCells box;
    box.type = type;
    box.divisions = {{divisions, divisions, 3}};
    box.place = [&](const Point<3> &p)
    { return Point<3>(width * (p[0] - 0.5), width * (p[1] - 0.5), height * (upper ? p[2] : p[2] - 1)); };
    MeshFileParameters parameters;
    parameters.file = scratch_folder() + "/contact_patch_" + type + ".inp";
    box.write(parameters.file);
    parameters.contact_group = upper ? "bottom" : "top";
    parameters.held_groups = {upper ? "top" : "bottom"};
    parameters.refinement.cell_size = 0;
    return compliance_of(make_mesh_from_file(parameters, 0, &g, "block", MPI_COMM_WORLD),
                         upper ? "top" : "bottom", 2, g);
  }

  const HalfSpaceMaterial rigid{std::numeric_limits<double>::infinity(), 0.3};

  /// Gap that uniform pressure on the whole square closes: approach less the displacements at the points.
  std::vector<double> gap_of_uniform_pressure(const HalfSpacePair &pair, const ContactGrid &g,
                                              const double force, const double approach)
  {
    std::vector<double> gap;
    for (unsigned int i = 0; i < g.n_points(); ++i)
      gap.push_back(approach - force * pair.influence(g.x(i), g.y(i), width, width)[0][0]);
    return gap;
  }
} // namespace

TEST(ContactPatch, matching_nodes)
{
  for (const unsigned int degree : {1, 2})
  {
    const auto [low, high] = blocks(11, 11, degree, grid(11));
    EXPECT_NEAR(low, 1, 1e-10);
    EXPECT_NEAR(high, 1, 1e-10);
  }
}

TEST(ContactPatch, interpolated_nodes)
{
  for (const unsigned int lower : {8, 9, 10})
  {
    const auto [low, high] = blocks(11, lower, 2, grid(11));
    EXPECT_NEAR(low, 1, 1e-2);
    EXPECT_NEAR(high, 1, 1e-2);
  }
}

TEST(ContactPatch, tetrahedra_and_prisms)
{
  const auto meet = [](const std::string &upper, const unsigned int above, const std::string &lower,
                       const unsigned int below)
  {
    const ContactGrid g = grid(9);
    DenseMatrix sum = compliance_from_file(upper, above, true, g);
    sum.add(1., compliance_from_file(lower, below, false, g));
    const double approach = 1e-6;
    return pressures(rolling_operator(g, std::move(sum), creep_schemes().front(), 1.), g,
                     std::vector<double>(g.n_points(), 0.), approach, young * approach / (2 * height),
                     upper + " " + std::to_string(above) + " on " + lower + " " + std::to_string(below));
  };
  // Of equal meshes the rule of each point's sub-cells is all that is not exact; the others cannot follow each other's
  // displacement within a cell.
  const auto [low, high] = meet("C3D10", 9, "C3D10", 9);
  EXPECT_NEAR(low, 1, 1e-4);
  EXPECT_NEAR(high, 1, 1e-4);
  for (const auto &[lowest, highest] : {meet("C3D10", 9, "C3D10", 7), meet("C3D15", 9, "C3D10", 6)})
  {
    EXPECT_NEAR(lowest, 1, 5e-3);
    EXPECT_NEAR(highest, 1, 5e-3);
  }
}

TEST(ContactPatch, half_spaces)
{
  const ContactGrid g = grid(11);
  const HalfSpacePair pair({young, 0.3}, {0.7 * young, 0.25});
  const double pressure = 1e8, force = pressure * width * width, approach = 3e-5;
  const auto [low, high] =
      pressures(rolling_operator(g, pair, creep_schemes().front(), 1.), g,
                gap_of_uniform_pressure(pair, g, force, approach), approach, pressure, "half-spaces");
  EXPECT_NEAR(low, 1, 1e-10);
  EXPECT_NEAR(high, 1, 1e-10);
}

TEST(ContactPatch, block_on_half_space)
{
  const ContactGrid g = grid(11);
  const HalfSpacePair pair(rigid, {young, 0.3});
  const double pressure = 1e8, force = pressure * width * width,
               approach = 3e-5 + pressure * height / young; // the block gives way as a whole
  const auto gap = gap_of_uniform_pressure(pair, g, force, 3e-5);
  for (const unsigned int divisions : {11, 9})
  {
    DenseMatrix sum = compliance("bottom", divisions, 2, g);
    sum.add(1., half_space_compliance(g, pair));
    const auto [low, high] =
        pressures(rolling_operator(g, std::move(sum), creep_schemes().front(), 1.), g, gap, approach,
                  pressure, "block of " + std::to_string(divisions) + " cells on a half-space");
    const double tolerance = divisions == g.n_x ? 1e-10 : 1e-2;
    EXPECT_NEAR(low, 1, tolerance);
    EXPECT_NEAR(high, 1, tolerance);
  }
}
