// Contact patch test: two blocks pressed together by a plane displacement carry a uniform pressure, with
// matching nodes exactly, with other nodes nearly; through the whole chain of elements, trace, compliance and
// contact solver.

#include <vibrocontact/contact/contact_solver.h>
#include <vibrocontact/contact/interface.h>
#include <vibrocontact/fe/elastic_body.h>
#include <vibrocontact/reduction/flexibility.h>
#include <vibrocontact/scene/block.h>

#include <gtest/gtest.h>

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
    BodyMesh<3> mesh = make_block<3>(parameters, "block", MPI_COMM_WORLD);
    ElasticModel<3> model;
    model.material.young_modulus = young;
    model.material.poisson_ratio = 0;
    model.held = {mesh.boundary_id(contact_face == "top" ? "bottom" : "top")};
    const ElasticBody<3> body(std::move(mesh), model, degree);
    const auto system = body.assemble(&g);
    Flexibility flexibility(*system);
    return flexibility.contact_compliance();
  }

  /// Smallest and largest pressure over the exact one, all points in contact.
  std::pair<double, double> pressures(const unsigned int upper, const unsigned int lower,
                                      const unsigned int degree, const ContactGrid &g)
  {
    DenseMatrix sum = compliance("bottom", upper, degree, g);
    sum.add(1., compliance("top", lower, degree, g));
    const CreepScheme &scheme = creep_schemes().front();
    ContactInterface interface;
    interface.grid = g;
    interface.gap.assign(g.n_points(), 0.);
    ContactParameters parameters;
    parameters.friction = 0;
    ContactProblem problem = rolling_problem(rolling_operator(g, std::move(sum), scheme, 1.), interface,
                                             scheme, Creepage(), parameters);
    problem.approach = 1e-6;
    const ContactSolution solution = create_contact_solver(ContactSolverParameters())->solve(problem, {});
    EXPECT_TRUE(solution.converged);
    const double exact = young * problem.approach / (2 * height);
    double low = 1e300, high = 0;
    for (unsigned int i = 0; i < g.n_points(); ++i)
    {
      low = std::min(low, solution.R(i) / g.cell_area() / exact);
      high = std::max(high, solution.R(i) / g.cell_area() / exact);
    }
    std::cout << upper << " on " << lower << " cells of degree " << degree << ", " << g.n_x
              << " points: pressure " << low - 1 << " .. " << high - 1 << std::endl;
    return {low, high};
  }
} // namespace

TEST(ContactPatch, matching_nodes)
{
  for (const unsigned int degree : {1, 2})
  {
    const auto [low, high] = pressures(11, 11, degree, grid(11));
    EXPECT_NEAR(low, 1, 1e-10);
    EXPECT_NEAR(high, 1, 1e-10);
  }
}

TEST(ContactPatch, interpolated_nodes)
{
  for (const unsigned int lower : {8, 9, 10})
  {
    const auto [low, high] = pressures(11, lower, 2, grid(11));
    EXPECT_NEAR(low, 1, 1e-2);
    EXPECT_NEAR(high, 1, 1e-2);
  }
}
