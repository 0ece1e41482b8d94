// Bodies of revolution that turn about their axle: rigid motions of a free body, axes that stand still against axes that
// turn, the thin ring of Bryan (1890), the slope of frequencies over the speed.
#include <vibrocontact/base/log.h>
#include <vibrocontact/fe/revolved_section.h>
#include <vibrocontact/reduction/compute_modes.h>

#include <deal.II/grid/grid_generator.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace vibrocontact;

namespace
{
  /// a ring of rectangular section between two radii
  RevolvedSection ring(const double inner, const double outer, const double width, const unsigned int cells)
  {
    const auto section = std::make_shared<dealii::Triangulation<2>>();
    dealii::GridGenerator::subdivided_hyper_rectangle(*section, {cells, cells}, {-width / 2, inner},
                                                      {width / 2, outer});
    return RevolvedSection("ring", section, ElasticModel<3>(), 4);
  }

  /// In the modes of the body at rest, rigid ones included.
  struct InModes
  {
    std::vector<double> omega;
    DenseMatrix coriolis, centripetal, geometric;
  };

  InModes in_modes(const RevolvedSection &section, const unsigned int n, const unsigned int count)
  {
    run_log().set_screen(false);
    const auto still = section.system(0);
    Flexibility flexibility(*still);
    const auto load = section.centrifugal_load();
    dealii::PETScWrappers::MPI::Vector stretched(load);
    flexibility.vmult(stretched, load);
    const auto rotation = section.rotation(n, stretched);

    const auto system = section.system(n);
    Flexibility own(*system);
    ModeParameters parameters;
    parameters.count = count;
    const Modes modes = compute_modes(*system, own, parameters);
    InModes result;
    result.omega = modes.omega;
    const auto project = [&](const dealii::PETScWrappers::MPI::SparseMatrix &matrix)
    {
      DenseMatrix dense(modes.omega.size(), modes.omega.size());
      dealii::PETScWrappers::MPI::Vector product(stretched);
      for (unsigned int j = 0; j < dense.n(); ++j)
      {
        matrix.vmult(product, modes.shapes[j]);
        for (unsigned int i = 0; i < dense.m(); ++i)
          dense(i, j) = modes.shapes[i] * product;
      }
      return dense;
    };
    result.coriolis = project(rotation->coriolis);
    result.centripetal = project(rotation->centripetal);
    result.geometric = project(rotation->geometric);
    return result;
  }

  /// Real roots of w^2 - 2 Omega G w - (diag(omega^2) - Omega^2 (C - K_g)) = 0, ascending: waves e^(i w t) of one sense.
  std::vector<double> roots(const InModes &body, const DenseMatrix &G, const DenseMatrix &C,
                            const double Omega)
  {
    const unsigned int n = body.omega.size();
    double scale = 1;
    for (const double omega : body.omega)
      scale = std::max(scale, omega);
    dealii::LAPACKFullMatrix<double> companion(2 * n, 2 * n);
    for (unsigned int i = 0; i < n; ++i)
    {
      companion(i, n + i) = 1;
      for (unsigned int j = 0; j < n; ++j)
      {
        companion(n + i, j) = ((i == j ? body.omega[i] * body.omega[i] : 0.) -
                               Omega * Omega * (C(i, j) - body.geometric(i, j))) /
                              (scale * scale);
        companion(n + i, n + j) = 2 * Omega * G(i, j) / scale;
      }
    }
    companion.compute_eigenvalues();
    std::vector<double> result;
    for (unsigned int k = 0; k < 2 * n; ++k)
    {
      EXPECT_LT(std::abs(companion.eigenvalue(k).imag()), 1e-7);
      result.push_back(scale * companion.eigenvalue(k).real());
    }
    std::sort(result.begin(), result.end());
    return result;
  }
} // namespace

// Translation stays, the tilted axle of a free top turns with Omega I_p / I_t.
TEST(RevolvedRotation, RigidMotionsOfAFreeBody)
{
  const double inner = 0.06, outer = 0.1, width = 0.03, Omega = 60;
  const InModes body = in_modes(ring(inner, outer, width, 3), 1, 12);
  std::vector<double> found = roots(body, body.coriolis, body.centripetal, Omega);
  std::sort(found.begin(), found.end(),
            [](const double a, const double b) { return std::abs(a) < std::abs(b); });
  const double squares = inner * inner + outer * outer, I_p = squares / 2,
               I_t = (3 * squares + width * width) / 12;
  for (unsigned int k = 0; k < 3; ++k)
    EXPECT_LT(std::abs(found[k]), 1e-4 * Omega) << k;
  EXPECT_NEAR(std::abs(found[3]), Omega * I_p / I_t, 1e-6 * Omega);
  // for a tilt the stress takes back what the centripetal acceleration does
  EXPECT_GT(body.centripetal(1, 1), 0.1);
  EXPECT_NEAR(body.geometric(1, 1), body.centripetal(1, 1), 1e-6);
}

// A frequency in axes that stand still is that in axes that turn plus n Omega.
TEST(RevolvedRotation, TwoFrames)
{
  const unsigned int n = 3;
  const double Omega = 200;
  const InModes body = in_modes(ring(0.06, 0.1, 0.03, 2), n, 10);
  DenseMatrix S = body.coriolis, across = body.centripetal;
  for (unsigned int i = 0; i < S.m(); ++i)
    for (unsigned int j = 0; j < S.n(); ++j)
    {
      S(i, j) -= i == j ? n : 0.;
      across(i, j) -= 2. * n * S(i, j) + (i == j ? double(n) * n : 0.);
    }
  const std::vector<double> still = roots(body, body.coriolis, body.centripetal, Omega),
                            turning = roots(body, S, across, Omega);
  for (unsigned int k = 0; k < still.size(); ++k)
    EXPECT_NEAR(still[k], turning[k] + n * Omega, 1e-10 * body.omega.back()) << k;
  // slope at rest
  const double small = 1e-3;
  const std::vector<double> nearly = roots(body, body.coriolis, body.centripetal, small);
  for (unsigned int k = 0; k < body.omega.size(); ++k)
    EXPECT_NEAR((nearly[body.omega.size() + k] - body.omega[k]) / small, body.coriolis(k, k), 1e-6 * n) << k;
}

// In-plane bending without stretch, extrapolated in the thickness: in turning axes the pattern lags by 2 n / (n^2 + 1) of
// a rotation each radian over n.
TEST(RevolvedRotation, ThinRing)
{
  for (const unsigned int n : {2, 3, 4})
  {
    std::vector<double> lag;
    for (const double thickness : {4e-3, 2e-3, 1e-3})
    {
      const InModes body = in_modes(ring(0.1 - thickness / 2, 0.1 + thickness / 2, thickness, 1), n, 2);
      // bending in the plane has a coupling of U and V, that out of it none
      double own = 0;
      for (unsigned int k = 0; k < body.omega.size(); ++k)
        own = std::max(own, n - body.coriolis(k, k));
      lag.push_back(own);
    }
    const double coarse = (4 * lag[1] - lag[0]) / 3, fine = (4 * lag[2] - lag[1]) / 3,
                 exact = 2. * n / (n * n + 1.);
    EXPECT_NEAR((16 * fine - coarse) / 15, exact, 1e-4 * exact) << n;
  }
}
