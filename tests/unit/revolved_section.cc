// Bodies of revolution wave by wave around the axle: the free solid sphere in closed form, the shipped wheel, its contact
// compliance over the number of waves.
#include "pi.h"

#include <vibrocontact/base/log.h>
#include <vibrocontact/contact/short_waves.h>
#include <vibrocontact/reduction/compute_modes.h>
#include <vibrocontact/reduction/revolved_reduction.h>
#include <vibrocontact/scene/revolved_mesh.h>
#include <vibrocontact/scene/wheel.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <gtest/gtest.h>

#include <boost/math/special_functions/bessel.hpp>
#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>

using namespace vibrocontact;

namespace
{
  double bessel(const unsigned int l, const double x)
  {
    return boost::math::sph_bessel(l, x);
  }

  /// Roots below a limit of a function of y = w R / c_s, found by its signs.
  void add_roots(const std::function<double(double)> &f, const double limit, std::vector<double> &roots)
  {
    const double step = 0.01;
    for (double y = 0.5; y < limit; y += step)
      if (f(y) * f(y + step) < 0)
      {
        const auto found =
            boost::math::tools::bisect(f, y, y + step, boost::math::tools::eps_tolerance<double>(50));
        roots.push_back(found.first);
      }
  }

  /// Free solid sphere (Lamb 1882; Eringen & Suhubi 1975, ch. 8): y of the modes with n waves, ascending.
  std::vector<double> sphere(const unsigned int n, const double speed_ratio, const double limit)
  {
    std::vector<double> roots;
    for (unsigned int l = std::max(n, 1u); l < 12; ++l)
    {
      add_roots([&](const double y) { return (l - 1.) * bessel(l, y) - y * bessel(l + 1, y); }, limit, roots);
      add_roots(
          [&](const double y)
          {
            const double x = y / speed_ratio, L = l;
            const double a = (L * (L - 1) - y * y / 2) * bessel(l, x) + 2 * x * bessel(l + 1, x),
                         b = L * (L + 1) * ((L - 1) * bessel(l, y) - y * bessel(l + 1, y)),
                         c = (L - 1) * bessel(l, x) - x * bessel(l + 1, x),
                         d = (L * L - 1 - y * y / 2) * bessel(l, y) + y * bessel(l + 1, y);
            return a * d - b * c;
          },
          limit, roots);
    }
    if (n == 0)
      // breathing: T_11 of l = 0
      add_roots(
          [&](const double y)
          {
            const double x = y / speed_ratio;
            return -y * y / 2 * bessel(0, x) + 2 * x * bessel(1, x);
          },
          limit, roots);
    std::sort(roots.begin(), roots.end());
    return roots;
  }

  std::vector<double> frequencies(const RevolvedSection &section, const unsigned int n,
                                  const unsigned int count)
  {
    run_log().set_screen(false);
    const auto system = section.system(n);
    Flexibility flexibility(*system);
    ModeParameters parameters;
    parameters.count = count;
    const Modes modes = compute_modes(*system, flexibility, parameters);
    return {modes.omega.begin() + modes.n_rigid_modes, modes.omega.end()};
  }

  RevolvedReduction wheel(const WheelParameters &parameters, const ContactGrid *grid)
  {
    const std::vector<ContactPlace> none;
    const RevolvedMesh mesh = parameters.make_section({"wheel", 0., none, grid, {}, MPI_COMM_SELF});
    ElasticModel<3> model;
    model.held = {mesh.held};
    std::optional<RevolvedReduction::Contact> contact;
    if (grid)
      contact = RevolvedReduction::Contact{
          *grid, mesh.tread, {206.9e9, 0.288}, mesh.n_harmonics, mesh.surface_height};
    return RevolvedReduction(
        std::make_unique<RevolvedSection>("wheel", mesh.triangulation, model, mesh.degree), "wheel",
        mesh.radius, 0., contact, MPI_COMM_SELF);
  }
} // namespace

// It has modes in every n, touches the axle and is free.
TEST(RevolvedSection, FreeSphere)
{
  const double R = 0.1;
  ElasticModel<3> model;
  const double mu = model.material.mu(), rho = model.material.density, slow = std::sqrt(mu / rho),
               ratio = std::sqrt((model.material.lambda() + 2 * mu) / mu);
  const auto disc = std::make_shared<dealii::Triangulation<2>>();
  dealii::GridGenerator::half_hyper_ball(*disc, dealii::Point<2>(), R);
  dealii::GridTools::rotate(pi / 2, *disc);
  disc->refine_global(2);
  const RevolvedSection section("sphere", disc, model, 4);
  EXPECT_NEAR(section.mass(), rho * 4 * pi / 3 * R * R * R, 1e-6 * section.mass());
  double worst = 0;
  for (unsigned int n = 0; n < 5; ++n)
  {
    const std::vector<double> exact = sphere(n, ratio, 8), found = frequencies(section, n, 6);
    ASSERT_GE(exact.size(), 6u);
    for (unsigned int k = 0; k < 6; ++k)
    {
      const double error = found[k] * R / slow / exact[k] - 1;
      worst = std::max(worst, std::abs(error));
      EXPECT_LT(std::abs(error), 2e-5) << n << " waves, mode " << k;
    }
  }
  RecordProperty("error", std::to_string(worst));
}

// The table of the section, converged by Fourier elements of another program.
TEST(RevolvedSection, ShippedWheel)
{
  run_log().set_screen(false);
  WheelParameters parameters;
  parameters.model = "harmonics";
  parameters.section.element_degree = 3;
  ModeParameters wanted;
  wanted.upper_frequency = 8000;
  SurfaceShapes shapes;
  RevolvedShapes on_section;
  const ModalReduction modes = wheel(parameters, nullptr).modes(wanted, WheelFrame(), shapes, on_section);
  EXPECT_EQ(modes.omega.size(), 101u);
  const std::vector<std::pair<std::string, double>> table = {
      {"axial(0,1)", 136.3},  {"axial(0,2)", 334.1},  {"axial(0,3)", 918.0}, {"axial(0,4)", 1670.1},
      {"radial(1,5)", 3278},  {"axial(0,6)", 3413},   {"axial(0,0)", 197.6}, {"torsion(0,0)", 510.7},
      {"axial(0,5)", 2515.8}, {"axial(0,7)", 4336.9}, {"axial(0,10)", 7170}};
  for (const auto &[label, frequency] : table)
  {
    const auto found = std::find(modes.labels.begin(), modes.labels.end(), label);
    ASSERT_NE(found, modes.labels.end()) << label;
    EXPECT_NEAR(modes.omega[found - modes.labels.begin()] / (2 * pi), frequency, 5e-4 * frequency) << label;
  }
  ASSERT_EQ(shapes.n_modes(), 101u);
}

// Waves that the section does not have are those of a round half-space: the sum does not depend on where one takes over. Every block
// of the compliance, motions along one direction under forces along another, over its own largest entry.
TEST(RevolvedSection, ComplianceOverWaves)
{
  run_log().set_screen(false);
  ContactGrid grid;
  grid.n_x = 5;
  grid.n_y = 5;
  grid.spacing_x = grid.spacing_y = 2e-3;
  grid.x_first = grid.y_first = -4e-3;
  const auto compliance = [&](const unsigned int n_harmonics)
  {
    WheelParameters parameters;
    parameters.model = "harmonics";
    parameters.section.element_degree = 3;
    parameters.refinement.cell_size = 1e-3;
    parameters.n_harmonics = n_harmonics;
    return wheel(parameters, &grid).statics().compliance;
  };
  const DenseMatrix finest = compliance(160);
  const unsigned int n = grid.n_points();
  const std::array<std::string, 3> names = {{"z", "x", "y"}};
  for (const unsigned int n_harmonics : {20, 40})
  {
    const DenseMatrix found = compliance(n_harmonics);
    for (unsigned int row = 0; row < 3; ++row)
      for (unsigned int column = 0; column <= row; ++column)
      {
        double largest = 0, error = 0;
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
          {
            const unsigned int a = contact_row(n, row, i), b = contact_row(n, column, j);
            largest = std::max(largest, std::abs(finest(a, b)));
            error = std::max(error, std::abs(found(a, b) - finest(a, b)));
          }
        const std::string which =
            names[row] + "_under_" + names[column] + "_with_" + std::to_string(n_harmonics);
        RecordProperty(which, std::to_string(error / largest));
        EXPECT_LT(error, (row == column ? 1e-3 : 2e-3) * largest) << which;
      }
  }
}

// Each band of waves stores energy by itself.
TEST(ShortWaves, BandsArePositive)
{
  ContactGrid grid;
  grid.n_x = 6;
  grid.n_y = 4;
  grid.spacing_x = 1e-3;
  grid.spacing_y = 1.5e-3;
  grid.x_first = -2.5e-3;
  grid.y_first = -2.25e-3;
  const HalfSpacePair pair({210e9, 0.3}, {std::numeric_limits<double>::infinity(), 0.});
  const std::vector<double> limits = {0, 40, 90, 400, 2000};
  std::vector<DenseMatrix> above;
  for (const double K : limits)
    above.push_back(short_wave_compliance(grid, pair, K));
  above.emplace_back(above[0].m(), above[0].n());
  for (unsigned int k = 0; k < limits.size(); ++k)
  {
    dealii::LAPACKFullMatrix<double> band(above[k]);
    band.add(-1., above[k + 1]);
    for (unsigned int i = 0; i < band.m(); ++i)
      for (unsigned int j = 0; j < i; ++j)
        ASSERT_NEAR(band(i, j), band(j, i), 1e-9 * above[0](0, 0));
    band.compute_eigenvalues();
    double low = 1e300, high = 0;
    for (unsigned int i = 0; i < band.m(); ++i)
    {
      low = std::min(low, band.eigenvalue(i).real());
      high = std::max(high, band.eigenvalue(i).real());
    }
    EXPECT_GT(high, 0) << "from " << limits[k];
    EXPECT_GT(low, -1e-6 * high) << "from " << limits[k];
  }
}
