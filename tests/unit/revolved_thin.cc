// Thin bodies of revolution at rest: their frequencies extrapolated in the thickness are those of the theories of rings and
// plates, in closed form.
#include <vibrocontact/base/log.h>
#include <vibrocontact/fe/revolved_section.h>
#include <vibrocontact/reduction/compute_modes.h>

#include <deal.II/grid/grid_generator.h>

#include <gtest/gtest.h>

#include <boost/math/special_functions/bessel.hpp>
#include <boost/math/special_functions/bessel_prime.hpp>
#include <boost/math/tools/roots.hpp>

#include <cmath>

using namespace vibrocontact;

namespace
{
  const double R = 0.1;

  /// Elastic angular frequencies of n waves, ascending, of a free body with a rectangular section.
  std::vector<double> frequencies(const double inner, const double outer, const double width,
                                  const unsigned int cells, const unsigned int n, const unsigned int count)
  {
    run_log().set_screen(false);
    const auto mesh = std::make_shared<dealii::Triangulation<2>>();
    dealii::GridGenerator::subdivided_hyper_rectangle(*mesh, {1u, cells}, {-width / 2, inner},
                                                      {width / 2, outer});
    const RevolvedSection section("thin", mesh, ElasticModel<3>(), 4);
    const auto system = section.system(n);
    Flexibility flexibility(*system);
    ModeParameters parameters;
    parameters.count = count;
    const Modes modes = compute_modes(*system, flexibility, parameters);
    return {modes.omega.begin() + modes.n_rigid_modes, modes.omega.end()};
  }

  /// Limit for thickness 0 of values at h, h/2, h/4 whose errors begin with h^first and h^second.
  double extrapolated(const std::vector<double> &values, const int first, const int second)
  {
    const double a = std::pow(2., first), b = std::pow(2., second),
                 coarse = (a * values[1] - values[0]) / (a - 1), fine = (a * values[2] - values[1]) / (a - 1);
    return (b * fine - coarse) / (b - 1);
  }

  /// lambda of a free circular plate without thickness, omega = lambda^2 / R^2 sqrt(D / (rho h)), n waves (Itao & Crandall 1979):
  /// bending moment and Kirchhoff's shear vanish at the rim for w = A J_n + B I_n.
  std::vector<double> free_plate(const unsigned int n, const double nu, const double limit)
  {
    const auto determinant = [&](const double x)
    {
      const double J = boost::math::cyl_bessel_j(n, x), dJ = boost::math::cyl_bessel_j_prime(n, x),
                   I = boost::math::cyl_bessel_i(n, x), dI = boost::math::cyl_bessel_i_prime(n, x),
                   N = double(n) * n, moment_J = x * x * J + (1 - nu) * (x * dJ - N * J),
                   moment_I = x * x * I - (1 - nu) * (x * dI - N * I),
                   shear_J = x * x * x * dJ + (1 - nu) * N * (x * dJ - J),
                   shear_I = x * x * x * dI - (1 - nu) * N * (x * dI - I);
      return (moment_J * shear_I - moment_I * shear_J) / (I * I);
    };
    std::vector<double> roots;
    const double step = 0.05;
    for (double x = 1; x < limit; x += step)
      if (determinant(x) * determinant(x + step) < 0)
        roots.push_back(boost::math::tools::bisect(determinant, x, x + step,
                                                   boost::math::tools::eps_tolerance<double>(40))
                            .first);
    return roots;
  }
} // namespace

// The first two modes of each n; the plate's rim has a boundary layer as wide as it is thick, so that errors begin with h.
TEST(RevolvedThin, FreePlate)
{
  const ElasticMaterial material;
  const double nu = material.poisson_ratio, E = material.young_modulus;
  double worst = 0;
  for (const unsigned int n : {0, 1, 2, 3})
  {
    const std::vector<double> exact = free_plate(n, nu, 9);
    ASSERT_GE(exact.size(), 2u) << n;
    std::array<std::vector<double>, 2> lambda;
    for (const double h : {4e-3, 2e-3, 1e-3})
    {
      const std::vector<double> omega = frequencies(0, R, h, 5, n, 2);
      for (unsigned int k = 0; k < 2; ++k)
        lambda[k].push_back(
            std::sqrt(omega[k] * R * R / std::sqrt(E * h * h / (12 * (1 - nu * nu) * material.density))));
    }
    for (unsigned int k = 0; k < 2; ++k)
    {
      const double error = std::pow(extrapolated(lambda[k], 1, 2) / exact[k], 2) - 1;
      worst = std::max(worst, std::abs(error));
      EXPECT_LT(std::abs(error), 1e-3) << n << " waves, mode " << k;
    }
  }
  RecordProperty("error", std::to_string(worst));
}

// A ring of square section, n = 2, 3, 4: bending in its plane without stretch (Hoppe 1871) and across it with torsion (Michell
// 1890), J = 0.1405770 h^4 of the square.
TEST(RevolvedThin, FreeRing)
{
  const ElasticMaterial material;
  const double twist = 1. / 12 * 2 * (1 + material.poisson_ratio) / 0.1405770;
  double worst = 0;
  for (const unsigned int n : {2, 3, 4})
  {
    const double N = double(n) * n;
    std::array<double, 2> exact = {{std::sqrt(N / (N + 1)) * (N - 1), std::sqrt(N / (N + twist)) * (N - 1)}};
    std::sort(exact.begin(), exact.end());
    std::array<std::vector<double>, 2> found;
    for (const double h : {8e-3, 4e-3, 2e-3})
    {
      const std::vector<double> omega = frequencies(R - h / 2, R + h / 2, h, 1, n, 2);
      const double scale = h / (R * R) * std::sqrt(material.young_modulus / (12 * material.density));
      for (unsigned int k = 0; k < 2; ++k)
        found[k].push_back(omega[k] / scale);
    }
    for (unsigned int k = 0; k < 2; ++k)
    {
      const double error = extrapolated(found[k], 2, 4) / exact[k] - 1;
      worst = std::max(worst, std::abs(error));
      EXPECT_LT(std::abs(error), 1e-3) << n << " waves, mode " << k;
    }
  }
  RecordProperty("error", std::to_string(worst));
}
