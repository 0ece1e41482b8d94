// Half-spaces at the ends of what they are for: no friction, friction 10, pure spin, hardly any stick, one point, a whole
// grid, dissimilar and incompressible bodies, moduli 1e9 apart, cells like slivers, distances of a million cells.

#include "../unit/contact_cases.h"
#include "../unit/hertz.h"
#include "../unit/pi.h"
#include "report.h"

#include <vibrocontact/contact/contact_solvers.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace vibrocontact;
using contact_cases::Case;

namespace
{
  /// Two equal bodies and a round contact of radius a: gap r^2 / (2 radius).
  struct Round
  {
    double E = 205e9, nu = 0.25, radius = 0.5, a = 5e-3, spacing = 0.5e-3, friction = 0.3;
    Creepage creepage;
    std::string scheme = "second-order upwind";

    HalfSpacePair pair() const { return HalfSpacePair({E, nu}, {E, nu}); }
    double force() const { return 4. / 3 * std::pow(a, 3) / radius / pair().inverse_contact_modulus(); }
    double shear_modulus() const { return E / (2 * (1 + nu)); }

    struct Sums
    {
      double N = 0, Tx = 0, Ty = 0, moment = 0;
      unsigned int n_stick = 0;
    };

    Sums solve() const
    {
      ContactParameters contact;
      contact.spacing = spacing;
      contact.half_length = contact.half_width = 1.5 * a;
      contact.friction = friction;
      contact.creep_scheme = scheme;
      ContactInterface interface;
      const ContactGrid grid = interface.contacts.only() = contact.grid();
      for (unsigned int i = 0; i < grid.n_points(); ++i)
        interface.gap.push_back((grid.x(i) * grid.x(i) + grid.y(i) * grid.y(i)) / (2 * radius));
      const CreepScheme &creep = find_creep_scheme(scheme);
      ContactProblem problem = rolling_problem(rolling_operator(grid, pair(), creep, creepage.speed),
                                               interface, creep, creepage, contact);
      problem.normal_force = force();
      const ContactSolution s = create_contact_solver({})->solved(problem);
      EXPECT_TRUE(s.converged) << s.residual;
      Sums sums;
      const unsigned int n = grid.n_points();
      for (unsigned int i = 0; i < n; ++i)
      {
        const auto R = at_point(s.R, n, 3, i);
        sums.N += R[0];
        sums.Tx += R[1];
        sums.Ty += R[2];
        sums.moment += grid.x(i) * R[2] - grid.y(i) * R[1];
        sums.n_stick += s.status[i] == ContactStatus::stick;
      }
      return sums;
    }
  };

  /// Approach per force of a flat punch on a half-space, all of its points pressed down by the same depth.
  double punch_compliance(const HalfSpacePair &pair, const ContactGrid &grid, const double friction,
                          const bool round)
  {
    ContactProblem problem;
    problem.title = "punch";
    problem.A = std::make_shared<DenseContactOperator>(half_space_compliance(grid, pair));
    problem.b.reinit(problem.A->n_points() * 3);
    for (unsigned int i = 0; i < grid.n_points(); ++i)
      problem.b[i] = round && std::hypot(grid.x(i), grid.y(i)) > 1 ? 1e3 : 0;
    problem.mu.assign(grid.n_points(), friction);
    problem.normal_force = 1;
    const ContactSolution s = create_contact_solver({})->solved(problem);
    EXPECT_TRUE(s.converged) << s.residual;
    return s.approach;
  }

  /// n by n points of the square [-1, 1]^2.
  ContactGrid square_of(const unsigned int n)
  {
    ContactGrid grid;
    grid.n_x = grid.n_y = n;
    grid.spacing_x = grid.spacing_y = 2. / n;
    grid.x_first = grid.y_first = -1 + 1. / n;
    return grid;
  }
} // namespace

// Friction 0: Hertz's pressure, and tractions and moment that are zero to the bit, whatever the creepages.
TEST(HardHalfSpaces, NoFrictionUnderCreepagesAndSpin)
{
  Case one;
  one.pair = contact_cases::steel_pair();
  one.contact.friction = 0;
  one.rolling.creepage.longitudinal = 0.01;
  one.rolling.creepage.lateral = -0.02;
  one.rolling.creepage.spin = 3;
  const RollingResult result = one.run().front();
  const HertzContact hertz = hertz_contact(1 / 0.92, 1 / 0.6, one.pair.inverse_contact_modulus(), 66000.);
  EXPECT_TRUE(result.solution.converged);
  EXPECT_EQ(std::hypot(result.tangential_force[0], result.tangential_force[1]), 0);
  EXPECT_EQ(result.spin_moment, 0);
  EXPECT_NEAR(result.max_pressure / hertz.max_pressure, 1, 5e-3);
  report("pressure", result.max_pressure / hertz.max_pressure - 1);
}

// Friction 10: all but the trailing edge sticks, so that Kalker's linear theory holds (round contact, nu 0.25: C11 = 4.12,
// C22 = 3.67, C23 = 1.47; Kalker, Three-dimensional elastic bodies in rolling contact, 1990, App. E).
TEST(HardHalfSpaces, FrictionTenAgainstLinearTheory)
{
  Round round;
  round.friction = 10;
  const double G = round.shear_modulus(), a = round.a;
  round.creepage.longitudinal = 1e-4;
  const double c11 = -round.solve().Tx / (G * a * a * 1e-4);
  round.creepage.longitudinal = 0;
  round.creepage.lateral = 1e-4;
  const double c22 = -round.solve().Ty / (G * a * a * 1e-4);
  round.creepage.lateral = 0;
  round.creepage.spin = 0.02;
  const double c23 = std::abs(round.solve().Ty) / (G * std::pow(a, 3) * 0.02);
  EXPECT_NEAR(c11 / 4.12, 1, 0.03);
  EXPECT_NEAR(c22 / 3.67, 1, 0.03);
  EXPECT_NEAR(c23 / 1.47, 1, 0.05);
  report("C11", c11 / 4.12 - 1);
  report("C22", c22 / 3.67 - 1);
  report("C23", c23 / 1.47 - 1);
}

// Spin alone: no longitudinal force by symmetry; of much spin all slips about the centre, M = 3 pi / 16 mu N a.
TEST(HardHalfSpaces, PureSpin)
{
  Round round;
  for (const double spin : {0.3, 3., 1e5})
  {
    round.creepage.spin = spin;
    const Round::Sums sums = round.solve();
    EXPECT_LE(std::abs(sums.Tx), 1e-9 * round.friction * sums.N) << spin;
    if (spin < 1e4)
      continue;
    const double full = 3 * pi / 16 * round.friction * sums.N * round.a;
    EXPECT_NEAR(std::abs(sums.moment) / full, 1, 0.01);
    // the point about which it turns is half a cell of a scheme away: forces of that order
    EXPECT_LE(std::abs(sums.Ty), 0.05 * round.friction * sums.N);
    EXPECT_EQ(sums.n_stick, 0u);
    report("longitudinal force", sums.Tx / (round.friction * sums.N));
    report("moment", std::abs(sums.moment) / full - 1);
  }
}

// Carter's cylinders with a stick zone of a fiftieth and less: T / mu N = 1 - (s / a)^2; with none, mu N at every point.
TEST(HardHalfSpaces, NearlyFullSlip)
{
  const double E = 205e9, nu = 0.3, modulus = E / (2 * (1 - nu * nu)), radius = 0.46, a = 5e-3, mu = 0.3,
               length = 8, load = pi * a * a * modulus / (4 * radius) * length;
  const HalfSpacePair pair({E, nu}, {E, nu});
  ContactInterface interface;
  ContactGrid &grid = interface.contacts.only();
  const unsigned int cells = 200;
  grid.n_x = cells + 8;
  grid.n_y = 1;
  grid.spacing_x = 2 * a / cells;
  grid.spacing_y = length;
  grid.x_first = -a - 3.5 * grid.spacing_x;
  const unsigned int n = grid.n_points();
  for (unsigned int i = 0; i < n; ++i)
    interface.gap.push_back(grid.x(i) * grid.x(i) / (2 * radius));
  const CreepScheme &scheme = find_creep_scheme("second-order upwind");
  for (const double share : {0.1, 0.02, 1e-3, -1e-3, -1.})
  {
    Creepage creepage;
    creepage.longitudinal = mu * a * (1 - share) / radius;
    ContactParameters contact;
    contact.friction = mu;
    ContactProblem problem = rolling_problem(rolling_operator(grid, pair, scheme, creepage.speed), interface,
                                             scheme, creepage, contact);
    problem.normal_force = load;
    const ContactSolution s = create_contact_solver({})->solved(problem);
    EXPECT_TRUE(s.converged) << share << " " << s.residual;
    double force = 0;
    for (unsigned int i = 0; i < n; ++i)
    {
      force -= s.R[n + i];
      if (share < -0.5)
        EXPECT_NEAR(-s.R[n + i], mu * s.R[i], 1e-12 * mu * load);
    }
    const double error = force / (mu * load) - (1 - std::pow(std::max(share, 0.), 2));
    // limited by the square-root ends of the traction, as at any creepage
    EXPECT_LE(std::abs(error), 0.2 / cells) << share;
    report("T / mu N", error);
  }
}

// A grid of one point: approach = a N of its own cell; it slides, T = -mu N s / |s|, s = V xi + A T by its own upstream
// displacements.
TEST(HardHalfSpaces, GridOfOnePoint)
{
  const ContactGrid grid = single_point(1e-3);
  ContactInterface interface;
  interface.contacts.only() = grid;
  interface.gap = {0};
  const HalfSpacePair pair({205e9, 0.3}, {205e9, 0.3}); // normal forces move nothing tangentially
  const CreepScheme &scheme = find_creep_scheme("second-order upwind");
  Creepage creepage;
  creepage.longitudinal = 3e-3;
  creepage.lateral = 4e-3;
  ContactParameters contact;
  ContactProblem problem = rolling_problem(rolling_operator(grid, pair, scheme, creepage.speed), interface,
                                           scheme, creepage, contact);
  problem.normal_force = 100;
  const double h = 1e-3, V = creepage.speed, limit = contact.friction * 100;
  double slip[2] = {V * creepage.longitudinal, V * creepage.lateral}, A[2] = {0, 0};
  for (unsigned int k = 0; k < scheme.coefficients.size(); ++k)
    for (unsigned int c = 0; c < 2; ++c)
      A[c] += V / h * scheme.coefficients[k] * pair.influence(-(k * h), 0, h, h)[c + 1][c + 1];
  // |s| by bisection: s_c = slip_c / (1 + A_c mu N / |s|)
  double low = 0, high = 1;
  for (unsigned int k = 0; k < 200; ++k)
  {
    const double m = 0.5 * (low + high);
    (std::hypot(slip[0] / (m + A[0] * limit), slip[1] / (m + A[1] * limit)) > 1 ? low : high) = m;
  }
  for (const std::string method : {"automatic", "semi-smooth newton", "fixed point"})
  {
    ContactSolverParameters parameters;
    parameters.method = method;
    const ContactSolution s = create_contact_solver(parameters)->solved(problem);
    EXPECT_TRUE(s.converged) << method;
    EXPECT_NEAR(s.approach / (100 * pair.influence(0, 0, h, h)[0][0]), 1, 1e-9) << method;
    for (unsigned int c = 0; c < 2; ++c)
      EXPECT_NEAR(s.R[1 + c], -limit * slip[c] / (low + A[c] * limit), 1e-7 * limit) << method;
    report("force along x", s.R[1] / (-limit * slip[0] / (low + A[0] * limit)) - 1);
  }
}

// A square punch, all points of the grid in contact: N / depth = pi C E* side, as a charged plate, whose capacitance is
// 4 pi epsilon C side, C = 0.3667892 (Read, J. Comp. Phys. 133 (1997) 1). Of first order in the cells.
TEST(HardHalfSpaces, WholeGridIsASquarePunch)
{
  const double inf = std::numeric_limits<double>::infinity();
  const HalfSpacePair pair({inf, 0.3}, {1, 0.3}, false);
  double previous = 0;
  for (const unsigned int n : {6u, 12u, 24u})
  {
    const double stiffness =
        pair.inverse_contact_modulus() / punch_compliance(pair, square_of(n), 0.3, false);
    const double error = stiffness / (pi * 0.3667892 * 2) - 1;
    EXPECT_LE(std::abs(error), 0.35 / n);
    if (n == 24)
    {
      EXPECT_LE(std::abs(2 * error - previous), 2e-3);
      report("stiffness, 24 by 24 points", error);
      report("extrapolated with 12 by 12", 2 * error - previous);
    }
    previous = error;
  }
}

// A rough punch that sticks on a soft half-space, the most dissimilar pair: N / depth = 4 G a ln(3 - 4 nu) / (1 - 2 nu)
// (Mossakovskii, PMM 18 (1954) 187), a tenth above the smooth one at nu = 0.
TEST(HardHalfSpaces, DissimilarBondedPunch)
{
  const double inf = std::numeric_limits<double>::infinity();
  double last = 0;
  for (const double nu : {0., 0.3})
  {
    const HalfSpacePair pair({inf, 0.3}, {1, nu});
    const double G = 1 / (2 * (1 + nu));
    const double bonded = 4 * G * std::log(3 - 4 * nu) / (1 - 2 * nu), smooth = 4 * G / (1 - nu);
    const unsigned int n = 25;
    // the round border of square cells cancels in the ratio of both
    const double ratio =
        punch_compliance(pair, square_of(n), 0, true) / punch_compliance(pair, square_of(n), 10, true);
    last = ratio / (bonded / smooth) - 1;
    EXPECT_NEAR(last, 0, 5e-3) << nu;
    report("bonded over smooth stiffness", last);
  }
}

// nu = 0.4999: normal and tangential problems hardly feel each other, c = (1 - 2 nu) / 4 pi G; the pair of a rigid and a nearly
// incompressible body is that without coupling but for it.
TEST(HardHalfSpaces, NearlyIncompressible)
{
  const double inf = std::numeric_limits<double>::infinity();
  double force[3];
  unsigned int k = 0;
  for (const auto &[nu, coupling] :
       {std::make_pair(0.4999, true), std::make_pair(0.5, true), std::make_pair(0.4999, false)})
  {
    Case one;
    one.pair = HalfSpacePair({inf, 0.3}, {10e9, nu}, coupling);
    one.contact.half_length = one.contact.half_width = 20e-3;
    one.rolling.normal_force = {20000};
    one.rolling.creepage.lateral = 0.01;
    const RollingResult result = one.run().front();
    EXPECT_TRUE(result.solution.converged);
    force[k++] = result.tangential_force[1];
  }
  EXPECT_NEAR(force[0] / force[1], 1, 3e-4);
  EXPECT_NEAR(force[0] / force[2], 1, 3e-4);
  report("against 0.5", force[0] / force[1] - 1);
  report("against no coupling", force[0] / force[2] - 1);
}

// A body 1e9 times as stiff as the other is a rigid one, to 1e-8.
TEST(HardHalfSpaces, ModuliABillionApart)
{
  RollingResult results[2];
  for (const bool rigid : {false, true})
  {
    Case one;
    one.pair = HalfSpacePair({rigid ? std::numeric_limits<double>::infinity() : 1e18, 0.3}, {1e9, 0.4});
    one.contact.half_length = one.contact.half_width = 20e-3;
    one.rolling.normal_force = {1000};
    one.rolling.creepage.longitudinal = 0.01;
    results[rigid] = one.run().front();
    EXPECT_TRUE(results[rigid].solution.converged);
  }
  EXPECT_NEAR(results[0].approach / results[1].approach, 1, 1e-8);
  EXPECT_NEAR(results[0].tangential_force[0] / results[1].tangential_force[0], 1, 1e-7);
  report("force", results[0].tangential_force[0] / results[1].tangential_force[0] - 1);
}

// A thousand slivers of 1 mm by 1 um are a square of 1 mm, also at their corners and borders.
TEST(HardHalfSpaces, CellsLikeSlivers)
{
  const HalfSpacePair pair = contact_cases::dissimilar_pair();
  double worst = 0;
  for (const auto &[x, y] :
       {std::make_pair(0., 0.), std::make_pair(0.5e-3, 0.5e-3), std::make_pair(0.5e-3, 0.),
        std::make_pair(2e-3, 1e-3), std::make_pair(0.1, -0.2)})
  {
    const auto whole = pair.influence(x, y, 1e-3, 1e-3);
    std::array<std::array<double, 3>, 3> sum{};
    for (unsigned int k = 0; k < 1000; ++k)
    {
      const auto part = pair.influence(x, y - (-0.5e-3 + (k + 0.5) * 1e-6), 1e-3, 1e-6);
      for (unsigned int r = 0; r < 3; ++r)
        for (unsigned int c = 0; c < 3; ++c)
          sum[r][c] += part[r][c] / 1000;
    }
    for (unsigned int r = 0; r < 3; ++r)
      for (unsigned int c = 0; c < 3; ++c)
        worst = std::max(worst, std::abs(sum[r][c] - whole[r][c]) / whole[0][0]);
  }
  EXPECT_LE(worst, 1e-9);
  report("sum of slivers", worst);
}

// Far away a cell is a point load, to (h / r)^2 / 8.
TEST(HardHalfSpaces, DistancesOfAMillionCells)
{
  const HalfSpacePair pair = contact_cases::dissimilar_pair();
  const auto [a, b, c] = pair.constants();
  double worst = 0;
  const double h = 1e-3;
  for (const double distance : {1e2, 1e3, 1e4, 1e5, 1e6})
    for (const double angle : {0., 0.3, 1.2, 2.5, 4.})
    {
      const double r = distance * h, x = r * std::cos(angle), y = r * std::sin(angle);
      const auto value = pair.influence(x, y, h, h);
      const double truth[3][3] = {
          {a / r, c * x / (r * r), c * y / (r * r)},
          {-c * x / (r * r), a / r + b * x * x / (r * r * r), b * x * y / (r * r * r)},
          {-c * y / (r * r), b * x * y / (r * r * r), a / r + b * y * y / (r * r * r)}};
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
        {
          const double error = std::abs(value[i][j] - truth[i][j]) / (a / r);
          EXPECT_LE(error, 0.2 / (distance * distance) + 1e-9) << distance << " " << angle << " " << i << j;
          if (distance > 1e4)
            worst = std::max(worst, error);
        }
    }
  report("against a point load", worst);
}

// Lateral creepage and spin of the other sign: all is mirrored.
TEST(HardHalfSpaces, MirroredCreepages)
{
  Round round;
  round.creepage.longitudinal = 1e-3;
  round.creepage.lateral = 2e-3;
  round.creepage.spin = 0.8;
  const Round::Sums one = round.solve();
  round.creepage.lateral *= -1;
  round.creepage.spin *= -1;
  const Round::Sums other = round.solve();
  const double size = round.friction * one.N;
  EXPECT_NEAR(one.Tx, other.Tx, 1e-9 * size);
  EXPECT_NEAR(one.Ty, -other.Ty, 1e-9 * size);
  EXPECT_NEAR(one.moment, -other.moment, 1e-9 * size * round.a);
  report("forces", std::max(std::abs(one.Tx - other.Tx), std::abs(one.Ty + other.Ty)) / size);
}

// The same contact a million times smaller and a thousand times softer: the same share of mu N.
TEST(HardHalfSpaces, NanometresOfRubber)
{
  Round round;
  round.creepage.longitudinal = 1e-3;
  round.creepage.spin = 0.8;
  const Round::Sums one = round.solve();
  for (double *const length : {&round.radius, &round.a, &round.spacing})
    *length *= 1e-6;
  round.E *= 1e-3;
  round.creepage.spin *= 1e6;
  const Round::Sums other = round.solve();
  EXPECT_NEAR(one.Tx / one.N, other.Tx / other.N, 1e-9);
  EXPECT_NEAR(one.Ty / one.N, other.Ty / other.N, 1e-9);
  report("forces over N",
         std::hypot(one.Tx / one.N - other.Tx / other.N, one.Ty / one.N - other.Ty / other.N));
}
