/// Rolling of two half-spaces against Hertz, Carter and the tables of the program CONTACT.

#include <vibrocontact/contact/contact_solvers.h>

#include "contact_cases.h"
#include "hertz.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace contact_cases;

namespace
{
  std::string data(const std::string &name)
  {
    return std::string(TESTS_DIRECTORY) + "/data/contact/" + name;
  }

  struct Comparison
  {
    double pressure_rms, traction_rms;
    unsigned int wrong_inside, wrong_near_border, points;
  };

  /// a result against CONTACT's patch table, mirrored; rms relative to p0 and mu p0
  Comparison compare_patch(const RollingResult &result, const ContactGrid &grid, const double mu,
                           const std::string &file_name)
  {
    const auto table = read_table(file_name);
    const unsigned int n = grid.n_points();
    std::vector<double> pressure(n), tx(n), ty(n);
    std::vector<int> state(n);
    for (unsigned int k = 0; k < table.at("x_mm").size(); ++k)
    {
      const int i = std::lround((-table.at("x_mm")[k] * 1e-3 - grid.x_first) / grid.spacing_x);
      const int j = std::lround((table.at("y_mm")[k] * 1e-3 - grid.y_first) / grid.spacing_y);
      const unsigned int point = grid.index(i, j);
      pressure[point] = table.at("pn_MPa")[k] * 1e6;
      tx[point] = -table.at("px_MPa")[k] * 1e6;
      ty[point] = table.at("py_MPa")[k] * 1e6;
      state[point] = table.at("state")[k];
    }
    const double p0 = *std::max_element(pressure.begin(), pressure.end());
    Comparison c{0, 0, 0, 0, 0};
    const double area = grid.cell_area();
    for (unsigned int p = 0; p < n; ++p)
    {
      const int own = static_cast<int>(result.solution.status[p]);
      if (own == 0 && state[p] == 0)
        continue;
      ++c.points;
      c.pressure_rms += std::pow((result.solution.R[p] / area - pressure[p]) / p0, 2);
      c.traction_rms += std::pow((result.solution.R[n + p] / area - tx[p]) / (mu * p0), 2) +
                        std::pow((result.solution.R[2 * n + p] / area - ty[p]) / (mu * p0), 2);
      if (own != state[p])
      {
        // next to a border: a neighbour has another status in the table
        bool border = false;
        for (const int step : {-1, 1, -int(grid.n_x), int(grid.n_x)})
          border = border || state[p + step] != state[p];
        ++(border ? c.wrong_near_border : c.wrong_inside);
      }
    }
    c.pressure_rms = std::sqrt(c.pressure_rms / c.points);
    c.traction_rms = std::sqrt(c.traction_rms / c.points);
    return c;
  }

  Case table_case(const char which, const double spacing)
  {
    Case one;
    one.contact.spacing = spacing;
    one.rolling.creepage.lateral = which == 'A' ? 0.002 : which == 'B' ? 0.01 : 0.005;
    if (which == 'F')
    {
      one.pair = dissimilar_pair();
      one.rolling.normal_force = {10000};
    }
    return one;
  }
} // namespace

TEST(HalfSpaceRolling, HertzPressureApproachAreaAndAxes)
{
  const HertzContact hertz = hertz_contact(1 / 0.92, 1 / 0.6, steel_pair().inverse_contact_modulus(), 66000.);
  EXPECT_NEAR(hertz.semi_axis_x, 6.284091e-3, 1e-9);
  EXPECT_NEAR(hertz.semi_axis_y, 4.727033e-3, 1e-9);
  EXPECT_NEAR(hertz.max_pressure, 1060.8505e6, 1e2);
  EXPECT_NEAR(hertz.approach, 0.08016511e-3, 1e-11);
  for (const double spacing : {1e-3, 0.25e-3})
  {
    Case one;
    one.contact.spacing = spacing;
    one.contact.friction = 0;
    const RollingResult result = one.run().front();
    ASSERT_TRUE(result.solution.converged);
    EXPECT_NEAR(result.normal_force, 66000, 1e-5);
    EXPECT_NEAR(result.max_pressure / hertz.max_pressure, 1, 5e-3);
    EXPECT_NEAR(result.approach / hertz.approach, 1, 5e-3);
    const double area = result.contact_points * spacing * spacing;
    EXPECT_NEAR(area / (dealii::numbers::PI * hertz.semi_axis_x * hertz.semi_axis_y), 1,
                spacing > 5e-4 ? 0.04 : 0.012);
    const ContactGrid grid = one.contact.grid();
    double half_x = 0, half_y = 0;
    for (unsigned int p = 0; p < grid.n_points(); ++p)
      if (result.solution.status[p] != ContactStatus::open)
      {
        half_x = std::max(half_x, grid.x(p));
        half_y = std::max(half_y, grid.y(p));
      }
    EXPECT_NEAR(half_x, hertz.semi_axis_x, spacing);
    EXPECT_NEAR(half_y, hertz.semi_axis_y, spacing);
  }
}

TEST(HalfSpaceRolling, PatchesEqualContact)
{
  for (const char which : {'A', 'B', 'F'})
    for (const bool fine : {false, true})
    {
      const Case one = table_case(which, fine ? 0.25e-3 : 1e-3);
      const RollingResult result = one.run().front();
      ASSERT_TRUE(result.solution.converged);
      const Comparison c =
          compare_patch(result, one.contact.grid(), 0.3,
                        data(std::string("patch_") + which + (fine ? "_0p25mm.csv" : "_1mm.csv")));
      std::cout << which << (fine ? " 0.25 mm" : " 1 mm") << ": rms pressure " << c.pressure_rms
                << ", traction " << c.traction_rms << ", status differs at " << c.wrong_near_border
                << " border points of " << c.points << "; utilisation " << result.utilisation
                << ", stick share " << double(result.stick_points) / result.contact_points << "\n";
      EXPECT_LE(c.pressure_rms, 0.01);
      EXPECT_LE(c.traction_rms, 0.01);
      EXPECT_EQ(c.wrong_inside, 0u);
      if (which == 'A' && fine)
        EXPECT_NEAR(double(result.stick_points) / result.contact_points, 0.53, 0.02);
      if (which == 'B')
        EXPECT_EQ(result.stick_points, 0u);
    }
}

TEST(HalfSpaceRolling, CreepForceAtTwoPerMille)
{
  const double limit = -0.712;
  Case one = table_case('A', 1e-3);
  EXPECT_NEAR(one.run().front().tangential_force[1] / (0.3 * 66000), -0.7458343, 0.005 * 0.7458343);
  one.contact.creep_scheme = "second-order upwind";
  EXPECT_NEAR(one.run().front().tangential_force[1] / (0.3 * 66000), limit, 0.015 * 0.712);
}

TEST(HalfSpaceRolling, CreepCurvesEqualContactOnTheSameGrid)
{
  for (const std::string which : {"lateral", "longitudinal", "spin"})
  {
    const auto table = read_table(data("creep_curve_" + which + ".csv"));
    const double tolerance = 0.005;
    double worst_force = 0, worst_moment = 0;
    for (unsigned int k = 0; k < table.at("mu").size(); ++k)
    {
      const double spacing = table.at("dx_mm")[k] * 1e-3;
      if (spacing < 0.9e-3)
        continue;
      Case one = table_case('A', spacing);
      one.contact.friction = table.at("mu")[k];
      one.rolling.creepage.longitudinal = -table.at("longitudinal")[k];
      one.rolling.creepage.lateral = table.at("lateral")[k];
      one.rolling.creepage.spin = -table.at("spin_1_m")[k];
      const RollingResult result = one.run().front();
      ASSERT_TRUE(result.solution.converged) << which << " row " << k;
      const double bound = one.contact.friction * 66000;
      const double force = std::hypot(result.tangential_force[0] / bound + table.at("Fx_over_muFn")[k],
                                      result.tangential_force[1] / bound - table.at("Fy_over_muFn")[k]);
      // moment relative to that of full sliding under spin, about mu N sqrt(a b) / 2
      const double moment = std::abs(result.spin_moment + table.at("Mz_Nmm")[k] * 1e-3) /
                            (bound * 0.5 * std::sqrt(6.28e-3 * 4.73e-3));
      worst_force = std::max(worst_force, force);
      worst_moment = std::max(worst_moment, moment);
      EXPECT_LE(force, tolerance) << which << " row " << k;
      EXPECT_LE(moment, 0.005) << which << " row " << k;
    }
    std::cout << which << ": largest difference of force " << worst_force << " mu N, of moment "
              << worst_moment << "\n";
  }
}

TEST(HalfSpaceRolling, SecondOrderCreepCurvesTendToTheLimit)
{
  // 2 F(0.25) - F(0.5) of CONTACT's first-order tables estimates the limit of a vanishing spacing.
  for (const std::string which : {"lateral", "longitudinal", "spin"})
  {
    const auto table = read_table(data("creep_curve_" + which + ".csv"));
    double worst = 0, worst_moment = 0;
    for (unsigned int k = 2; k < table.at("mu").size(); k += 9) // every third of the finest rows
    {
      ASSERT_NEAR(table.at("dx_mm")[k], 0.25, 1e-12);
      Case one = table_case('A', 0.25e-3);
      one.contact.creep_scheme = "second-order upwind";
      one.contact.friction = table.at("mu")[k];
      one.rolling.creepage.longitudinal = -table.at("longitudinal")[k];
      one.rolling.creepage.lateral = table.at("lateral")[k];
      one.rolling.creepage.spin = -table.at("spin_1_m")[k];
      const RollingResult result = one.run().front();
      ASSERT_TRUE(result.solution.converged) << which << " row " << k;
      const auto limit = [&](const std::string &column)
      { return 2 * table.at(column)[k] - table.at(column)[k - 1]; };
      const double bound = one.contact.friction * 66000;
      const double force = std::hypot(result.tangential_force[0] / bound + limit("Fx_over_muFn"),
                                      result.tangential_force[1] / bound - limit("Fy_over_muFn"));
      const double moment = std::abs(result.spin_moment + limit("Mz_Nmm") * 1e-3) /
                            (bound * 0.5 * std::sqrt(6.28e-3 * 4.73e-3));
      worst = std::max(worst, force);
      worst_moment = std::max(worst_moment, moment);
      EXPECT_LE(force, 0.015) << which << " row " << k;
    }
    std::cout << which << ": largest distance to the limit " << worst << " mu N, of the moment "
              << worst_moment << "\n";
  }
}

TEST(HalfSpaceRolling, CarterTractionsInTwoDimensions)
{
  // Closed form of Carter, one row of cells 8 m long; longitudinal creepage and its antiplane twin.
  const double E = 205e9, nu = 0.3, modulus = E / (2 * (1 - nu * nu)), radius = 0.46, a = 5e-3,
               a_stick = 3e-3, mu = 0.3, length = 8, p0 = modulus * a / (2 * radius),
               load = dealii::numbers::PI * 0.5 * p0 * a * length;
  const HalfSpacePair pair({E, nu}, {E, nu});
  for (const std::string scheme : {"first-order upwind", "second-order upwind"})
    for (const bool lateral : {false, true})
    {
      double previous = 0;
      for (const unsigned int cells : {20, 40, 80, 160})
      {
        const double h = 2 * a / cells;
        ContactInterface interface;
        interface.contacts.only().n_x = cells + 8;
        interface.contacts.only().n_y = 1;
        interface.contacts.only().spacing_x = h;
        interface.contacts.only().spacing_y = length;
        interface.contacts.only().x_first = -a - 4 * h + 0.5 * h;
        for (unsigned int i = 0; i < interface.contacts.only().n_points(); ++i)
          interface.gap.push_back(std::pow(interface.contacts.only().x(i), 2) / (2 * radius));
        const CreepScheme &creep_scheme = find_creep_scheme(scheme);
        Creepage creepage;
        const double creep = mu * (a - a_stick) / radius;
        (lateral ? creepage.lateral : creepage.longitudinal) = lateral ? creep / (1 - nu) : creep;
        ContactParameters contact;
        contact.friction = mu;
        ContactProblem problem =
            rolling_problem(rolling_operator(interface.contacts.only(), pair, creep_scheme, creepage.speed),
                            interface, creep_scheme, creepage, contact);
        problem.normal_force = load;
        const ContactSolution s = create_contact_solver({})->solved(problem);
        ASSERT_TRUE(s.converged);
        const unsigned int n = interface.contacts.only().n_points(), component = lateral ? 2 : 1;
        double force = 0;
        for (unsigned int i = 0; i < n; ++i)
          force += s.R[component * n + i];
        const double error = std::abs(force / (mu * load) + 0.64) / 0.64;
        std::cout << scheme << (lateral ? ", lateral, " : ", longitudinal, ") << cells << " cells: error "
                  << error << (previous > 0 ? ", order " + std::to_string(std::log2(previous / error)) : "")
                  << "\n";
        if (scheme == "first-order upwind" && cells == 40)
          EXPECT_NEAR(error, 0.0088, 2e-4); // CONTACT: 0.008808846
        if (previous > 0 && scheme == "first-order upwind")
          EXPECT_NEAR(std::log2(previous / error), 1., 0.1);
        if (scheme == "second-order upwind")
          EXPECT_LE(error, 0.2 / cells); // limited by the square-root ends of the traction
        previous = error;
      }
    }
}

TEST(QuasiStaticRolling, ACaseWithoutSolutionDoesNotEndTheSweep)
{
  contact_cases::Case c;
  c.contact.half_length = c.contact.half_width = 0.01;
  c.rolling.sweep.friction = {0.3, std::nan(""), 0.2};
  const std::vector<RollingResult> results = c.run();
  ASSERT_EQ(results.size(), 3u);
  EXPECT_TRUE(results[0].solution.converged && results[0].failure.empty());
  EXPECT_FALSE(results[1].solution.converged);
  EXPECT_NE(results[1].failure.find("not finite"), std::string::npos) << results[1].failure;
  EXPECT_EQ(results[1].normal_force, 0);
  EXPECT_TRUE(results[2].solution.converged && results[2].failure.empty());
}
