// Bodies of revolution that turn about their axle: rigid motions of a free body, axes that stand still against axes that
// turn, the thin ring of Bryan (1890), the slope of frequencies over the speed, the disc that its rotation alone holds
// (Lamb and Southwell 1921).
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

  /// Limit for thickness 0 of values at h, h/2, h/4, even in h.
  double extrapolated(const std::vector<double> &values)
  {
    const double coarse = (4 * values[1] - values[0]) / 3, fine = (4 * values[2] - values[1]) / 3;
    return (16 * fine - coarse) / 15;
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
    const double exact = 2. * n / (n * n + 1.);
    EXPECT_NEAR(extrapolated(lag), exact, 1e-4 * exact) << n;
  }
}

// The same ring under the tension of its own rotation, which is as strong as its bending stiffness: in turning axes
// w = 2 n Omega / (n^2 + 1) +- sqrt(w_0^2 + Omega^2 n^2 (n^2 - 1)^2 / (n^2 + 1)^2). Without stiffness one wave stands still.
TEST(RevolvedRotation, ThinRingUnderTension)
{
  const double R = 0.1;
  for (const unsigned int n : {2, 3})
  {
    std::vector<double> faster, slower;
    const double N = double(n) * n, lag = 2. * n / (N + 1), tension = n * (N - 1) / (N + 1),
                 root = tension * std::sqrt(2.);
    // over Omega, in axes that stand still
    const std::array<double, 2> exact = {{n - lag + root, n - lag - root}};
    for (const double thickness : {8e-3, 4e-3, 2e-3})
    {
      const ElasticMaterial material;
      const double w_0 = n * (N - 1) / std::sqrt(N + 1) * thickness / (R * R) *
                         std::sqrt(material.young_modulus / (12 * material.density)),
                   Omega = w_0 / tension;
      const InModes body = in_modes(ring(R - thickness / 2, R + thickness / 2, thickness, 1), n, 4);
      const std::vector<double> found = roots(body, body.coriolis, body.centripetal, Omega);
      const auto nearest = [&](const double w)
      {
        double best = found.front();
        for (const double one : found)
          if (std::abs(one - w) < std::abs(best - w))
            best = one;
        return best / Omega;
      };
      faster.push_back(nearest(exact[0] * Omega));
      slower.push_back(nearest(exact[1] * Omega));
    }
    EXPECT_NEAR(extrapolated(faster), exact[0], 1e-4 * n) << n;
    EXPECT_NEAR(extrapolated(slower), exact[1], 1e-4 * n) << n;
  }
}

// A disc without bending stiffness: w^2 / Omega^2 = ((n + 2 s) (n + 2 s + 2) (3 + nu) - n^2 (1 + 3 nu)) / 8 with s nodal circles,
// in axes that turn. The equations are linear in Omega^2, which is chosen so large that tension carries the disc.
TEST(RevolvedRotation, SpinningDisc)
{
  const double R = 0.1, Omega = 5e4, nu = ElasticMaterial().poisson_ratio;
  run_log().set_screen(false);
  for (const unsigned int n : {2, 3})
  {
    std::array<std::vector<double>, 2> squares;
    for (const double thickness : {1e-3, 5e-4, 2.5e-4})
    {
      const auto mesh = std::make_shared<dealii::Triangulation<2>>();
      dealii::GridGenerator::subdivided_hyper_rectangle(*mesh, {1u, 12u}, {-thickness / 2, 0.},
                                                        {thickness / 2, R});
      const RevolvedSection section("disc", mesh, ElasticModel<3>(), 4);
      const auto still = section.system(0);
      Flexibility flexibility(*still);
      const auto load = section.centrifugal_load();
      dealii::PETScWrappers::MPI::Vector stretched(load);
      flexibility.vmult(stretched, load);
      const auto system = section.system(n);
      system->stiffness.add(Omega * Omega, section.rotation(n, stretched)->geometric);
      // motions across the disc have neither Coriolis nor centripetal forces there
      Flexibility stiffened(*system);
      ModeParameters parameters;
      parameters.count = 8;
      const Modes modes = compute_modes(*system, stiffened, parameters);
      unsigned int s = 0;
      for (unsigned int k = 0; k < modes.omega.size() && s < 2; ++k)
      {
        double across = 0, all = 0;
        for (unsigned int dof = 0; dof < section.n_dofs(); ++dof)
        {
          const double square = std::pow(modes.shapes[k](dof), 2);
          all += square;
          if (section.components()[dof] == RevolvedSection::axial)
            across += square;
        }
        if (across > 0.5 * all)
          squares[s++].push_back(std::pow(modes.omega[k] / Omega, 2));
      }
      ASSERT_EQ(s, 2u);
    }
    for (unsigned int s = 0; s < 2; ++s)
    {
      const double order = n + 2. * s, exact = (order * (order + 2) * (3 + nu) - n * n * (1 + 3 * nu)) / 8;
      EXPECT_NEAR(extrapolated(squares[s]), exact, 1e-4 * exact) << n << " waves, " << s << " circles";
    }
  }
}
