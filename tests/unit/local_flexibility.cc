// The flexibility under the contact: half-spaces in place of the elements' own, normal/tangential coupling on and
// off, lumped and consistent quadrature.

#include "hertz.h"
#include "matrix_difference.h"

#include <vibrocontact/analyses/rolling/rolling_scene.h>
#include <vibrocontact/contact/half_space.h>
#include <vibrocontact/fe/assemble_body.h>
#include <vibrocontact/fe/make_elastic_body.h>
#include <vibrocontact/reduction/reduction_parts.h>
#include <vibrocontact/scene/block.h>
#include <vibrocontact/scene/half_space_body.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace vibrocontact;

namespace
{
  constexpr double spacing = 1e-3;

  ContactGrid grid(const unsigned int n)
  {
    ContactGrid g;
    g.n_x = g.n_y = n;
    g.spacing_x = g.spacing_y = spacing;
    g.x_first = g.y_first = -0.5 * (n - 1) * spacing;
    return g;
  }

  template <class Description>
  BodyParameters elastic(const std::string &type, const Description &description, const double young,
                         const double nu)
  {
    BodyParameters body = body_of(type, type, description);
    body.material.young_modulus = young;
    body.material.poisson_ratio = nu;
    return body;
  }

  /// A half-space or a rigid body with a spherical surface.
  template <class Surface = HalfSpaceParameters>
  BodyParameters surface(const double young, const double nu, const double radius)
  {
    Surface own;
    own.radius_x = own.radius_y = radius;
    return elastic(own.is_rigid() ? "rigid" : "half-space", own, young, nu);
  }

  struct Block
  {
    BodyParameters parameters;
    ReducedBody reduced;
    ContactBody body() const { return {&parameters, &reduced}; }
  };

  /// A cube's lower or upper half of so many contact cells, held at the face away from the contact.
  Block block(const unsigned int cells, const unsigned int elements_per_cell, const ContactGrid &g,
              const bool above)
  {
    Block result;
    BlockParameters own;
    own.divisions_x = own.divisions_y = cells * elements_per_cell;
    own.divisions_z = (own.divisions_x + 1) / 2;
    own.length = own.width = cells * spacing;
    own.height = own.divisions_z * spacing / elements_per_cell;
    own.contact_face = above ? "bottom" : "top";
    own.held = {above ? "top" : "bottom"};
    result.parameters = elastic("block", own, 2e11, 0.3);
    const auto elastic =
        make_elastic_body(result.parameters, 0, {{g, ContactFrame(), above}}, MPI_COMM_WORLD);
    const auto system = assemble_body(*elastic, &g);
    Flexibility flexibility(*system);
    result.reduced = combine(reduce_statically(*system, flexibility), nullptr);
    return result;
  }

  ContactParameters half_spaces()
  {
    ContactParameters contact;
    contact.local_flexibility = "half-space";
    return contact;
  }

  ContactParameters uncoupled()
  {
    ContactParameters contact;
    contact.coupling = false;
    return contact;
  }

  /// Entries of the blocks between the directions, the largest over the largest of all.
  double coupling(const DenseMatrix &W)
  {
    const unsigned int n = W.m() / 3;
    double largest = 0, scale = 0;
    for (unsigned int i = 0; i < 3 * n; ++i)
      for (unsigned int j = 0; j < 3 * n; ++j)
      {
        scale = std::max(scale, std::abs(W(i, j)));
        if ((i < n) != (j < n))
          largest = std::max(largest, std::abs(W(i, j)));
      }
    return largest / scale;
  }

  /// Mean over the cell at (x, y) of what a unit force spread over the cell at the origin does, as elements
  /// take it.
  double mean_influence(const HalfSpacePair &pair, const unsigned int row, const unsigned int column,
                        const double x, const double y)
  {
    constexpr int n = 40;
    double sum = 0;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        sum += pair.influence(x + ((i + 0.5) / n - 0.5) * spacing, y + ((j + 0.5) / n - 0.5) * spacing,
                              spacing, spacing)[row][column];
    return sum / (n * n);
  }

  const BodyParameters stop = surface<RigidParameters>(1, 0.3, 0.1);
  const ContactBody rigid{&stop, nullptr};

  RollingResult roll(const RollingGrid &scene, const ContactParameters &contact, const double force = 3000)
  {
    RollingParameters rolling;
    rolling.normal_force = {force};
    rolling.creepage.speed = 10;
    rolling.creepage.lateral = 0.05;
    rolling.creepage.longitudinal = 0.02;
    return quasi_static_rolling(rolling, contact, ContactSolverParameters(), scene.interface,
                                scene.operator_at, [](const RollingResult &, const ContactProblem &) {})
        .front();
  }

  double normal_difference(const RollingResult &a, const RollingResult &b)
  {
    EXPECT_TRUE(a.solution.converged && b.solution.converged);
    double largest = 0, scale = 0;
    for (unsigned int i = 0; i < a.solution.R.size() / 3; ++i)
    {
      largest = std::max(largest, std::abs(a.solution.R[i] - b.solution.R[i]));
      scale = std::max(scale, a.solution.R[i]);
    }
    return largest / scale;
  }
} // namespace

TEST(LocalFlexibility, HalfSpacesStayThemselves)
{
  const BodyParameters above = surface(2e11, 0.3, 0.1), below = surface(7e10, 0.2, 0);
  const ContactGrid g = grid(7);
  EXPECT_EQ(
      difference(residual_flexibility(contact_pair({&above, nullptr}, {&below, nullptr}, {}, g)),
                 residual_flexibility(contact_pair({&above, nullptr}, {&below, nullptr}, half_spaces(), g))),
      0.);
}

TEST(LocalFlexibility, ABlockIsAHalfSpaceNearby)
{
  // What the sides of the block change is smooth: the difference between neighbours is the half-space's, up to the
  // resolution of a cell's traction by the elements.
  const ContactGrid g = grid(3);
  const unsigned int n = g.n_points(), middle = g.index(1, 1);
  double error_before = 1;
  for (const unsigned int elements : {1, 2})
  {
    const Block own = block(7, elements, g, false);
    const HalfSpacePair pair({std::numeric_limits<double>::infinity(), 0.},
                             half_space_material(own.parameters));
    const DenseMatrix W = contact_pair(rigid, own.body(), {}, g).residual;
    EXPECT_EQ(difference(contact_pair(rigid, own.body(), half_spaces(), g).residual,
                         half_space_compliance(g, pair)),
              0.);
    double error = 0;
    for (unsigned int c = 0; c < 3; ++c)
    {
      const auto entry = [&](const unsigned int target)
      { return W(contact_row(n, c, target), contact_row(n, c, middle)); };
      const double near = entry(middle) - 0.25 * (entry(g.index(0, 1)) + entry(g.index(2, 1)) +
                                                  entry(g.index(1, 0)) + entry(g.index(1, 2))),
                   expected =
                       mean_influence(pair, c, c, 0, 0) - 0.5 * (mean_influence(pair, c, c, spacing, 0) +
                                                                 mean_influence(pair, c, c, 0, spacing));
      std::printf("%u elements per cell, direction %u: %+.2f %%\n", elements, c, 100 * (near / expected - 1));
      error = std::max(error, std::abs(near / expected - 1));
    }
    const auto turned = [&](const unsigned int target) { return W(target, contact_row(n, 1, middle)); };
    const double coupled = turned(g.index(2, 1)) - turned(g.index(0, 1)),
                 expected = mean_influence(pair, 0, 1, spacing, 0) - mean_influence(pair, 0, 1, -spacing, 0);
    std::printf("%u elements per cell, coupling: %+.2f %%\n", elements, 100 * (coupled / expected - 1));
    if (elements == 2)
      EXPECT_NEAR(coupled / expected, 1, 0.1);
    EXPECT_LT(error, 0.6 * error_before);
    error_before = error;
  }
  EXPECT_LT(error_before, 0.06);
}

TEST(LocalFlexibility, WithoutCoupling)
{
  const ContactGrid g = grid(5);
  const Block upper = block(7, 1, g, true), lower = block(7, 1, g, false);
  // of different bodies the blocks between the directions go, the others stay
  const BodyParameters soft = surface(7e10, 0.2, 0);
  const ContactPair with = contact_pair(upper.body(), {&soft, nullptr}, {}, g),
                    without = contact_pair(upper.body(), {&soft, nullptr}, uncoupled(), g);
  EXPECT_GT(coupling(with.residual), 1e-2);
  EXPECT_EQ(coupling(without.residual), 0.);
  DenseMatrix transposed(75), rest = with.residual;
  for (unsigned int i = 0; i < 75; ++i)
    for (unsigned int j = 0; j < 75; ++j)
    {
      transposed(i, j) = without.residual(j, i);
      if ((i < 25) != (j < 25))
        rest(i, j) = 0;
    }
  EXPECT_LT(difference(without.residual, transposed), 1e-12);
  EXPECT_EQ(difference(without.residual, rest), 0.);
  // bodies that mirror each other have none, half-spaces of one material neither
  EXPECT_LT(coupling(contact_pair(upper.body(), lower.body(), {}, g).residual), 1e-11);
  EXPECT_EQ(
      difference(residual_flexibility(contact_pair({&soft, nullptr}, {&soft, nullptr}, {}, g)),
                 residual_flexibility(contact_pair({&soft, nullptr}, {&soft, nullptr}, uncoupled(), g))),
      0.);
}

TEST(LocalFlexibility, WithoutCouplingFrictionLeavesThePressure)
{
  const BodyParameters above = surface(2e11, 0.3, 0.1), below = surface(2e10, 0.1, 0);
  const ContactGrid g = grid(13);
  ContactParameters contact;
  const auto rolled = [&](const bool coupled, const double friction)
  {
    contact.coupling = coupled;
    contact.friction = friction;
    return roll(rolling_grid({&above, nullptr}, {&below, nullptr}, contact, g), contact);
  };
  // the frictionless pressure is that of Hertz, and does not see the tangential directions
  const RollingResult frictionless = rolled(true, 0);
  const HertzContact hertz = hertz_contact(
      5, 5, HalfSpacePair(half_space_material(above), half_space_material(below)).inverse_contact_modulus(),
      3000);
  EXPECT_NEAR(frictionless.max_pressure / hertz.max_pressure, 1, 0.03);
  EXPECT_LT(normal_difference(rolled(false, 0), frictionless), 1e-9);
  EXPECT_LT(normal_difference(rolled(false, 0.6), frictionless), 1e-9);
  EXPECT_GT(normal_difference(rolled(true, 0.6), frictionless), 1e-3);
  // the convolution and the stored matrix are one operator
  const RollingGrid scene = rolling_grid({&above, nullptr}, {&below, nullptr}, uncoupled(), g);
  RollingGrid dense = scene;
  const ContactPair pair = contact_pair({&above, nullptr}, {&below, nullptr}, uncoupled(), g);
  dense.operator_at = [&](const double speed)
  { return rolling_operator(g, residual_flexibility(pair), find_creep_scheme(contact.creep_scheme), speed); };
  EXPECT_LT(normal_difference(roll(scene, uncoupled()), roll(dense, uncoupled())), 1e-8);
}

TEST(LocalFlexibility, QuadraturesMeet)
{
  // a sphere pressed on a block: the same approach with tractions that are constant on cells or bilinear
  ContactGrid g = grid(9);
  ContactParameters contact;
  contact.friction = 0;
  std::vector<RollingResult> results;
  const BodyParameters sphere = surface<RigidParameters>(1, 0.3, 0.4);
  const double force = 12000;
  for (const TractionShape shape : {TractionShape::constant, TractionShape::bilinear})
  {
    g.traction = shape;
    const Block own = block(9, 1, g, false);
    results.push_back(roll(rolling_grid({&sphere, nullptr}, own.body(), contact, g), contact, force));
    std::printf("%s: %u points, largest pressure %.4g MPa, approach %.4g um\n",
                shape == TractionShape::constant ? "lumped" : "consistent", results.back().contact_points,
                results.back().max_pressure * 1e-6, results.back().approach * 1e6);
  }
  const BodyParameters own = surface(2e11, 0.3, 0);
  const HertzContact hertz =
      hertz_contact(1.25, 1.25,
                    HalfSpacePair({std::numeric_limits<double>::infinity(), 0.}, half_space_material(own))
                        .inverse_contact_modulus(),
                    force);
  std::printf("Hertz: half axis %.3g mm, %.4g MPa\n", 1e3 * hertz.semi_axis_x, hertz.max_pressure * 1e-6);
  EXPECT_NEAR(results[0].max_pressure / hertz.max_pressure, 1, 0.1);
  EXPECT_NEAR(results[1].approach / results[0].approach, 1, 0.02);
}
