// What it changes to leave the damping of a residual flexibility out, against the receptance of all modes of a bar damped by C = beta K.

#include <vibrocontact/coupled_bodies/residual_damping.h>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

using namespace vibrocontact;

namespace
{
  /// Unit bar held at one end, modes sin((k - 1/2) pi x) at the other: n of them kept.
  ReducedBody held_unit_bar(const unsigned int n, const double beta)
  {
    ReducedBody body;
    body.grid.n_x = body.grid.n_y = 1;
    body.trace.reinit(3, n);
    body.residual.reinit(3, 3);
    body.residual(0, 0) = 1; // of the whole bar
    for (unsigned int k = 0; k < n; ++k)
    {
      const double omega = (k + 0.5) * M_PI;
      body.omega.push_back(omega);
      body.damping_ratio.push_back(beta * omega / 2);
      body.trace(0, k) = std::sqrt(2.);
      body.residual(0, 0) -= 2 / (omega * omega);
    }
    return body;
  }

  std::complex<double> receptance(const ReducedBody &body, const double omega)
  {
    std::complex<double> sum = body.residual(0, 0);
    for (unsigned int k = 0; k < body.omega.size(); ++k)
      sum += 2. / std::complex<double>(body.omega[k] * body.omega[k] - omega * omega,
                                       2 * body.damping_ratio[k] * body.omega[k] * omega);
    return sum;
  }
} // namespace

TEST(ResidualDamping, AgainstAllModes)
{
  for (const double beta : {1e-3, 1e-2})
    for (const double frequency : {0.1, 0.37, 0.6})
    {
      const double omega = 2 * M_PI * frequency;
      const ReducedBody few = held_unit_bar(5, beta), all = held_unit_bar(5000, beta);
      // the same without damping: what the mass of the dropped modes does, which is no matter of damping
      const std::complex<double> inertia =
          receptance(held_unit_bar(5000, 0), omega) - receptance(held_unit_bar(5, 0), omega);
      const double truth = std::abs(receptance(all, omega) - receptance(few, omega) - inertia) /
                           std::abs(receptance(few, omega));
      const DroppedDamping dropped = dropped_residual_damping({{&few, 0, beta, 0}}, 0, {frequency});
      std::printf("beta %.0e, %.2f Hz: %.3e, all modes %.3e\n", beta, frequency, dropped.change, truth);
      EXPECT_NEAR(dropped.change / truth, 1, 0.05);
      EXPECT_EQ(dropped.frequency, frequency);
    }
}

TEST(ResidualDamping, LossFactorAndFurtherCompliance)
{
  const ReducedBody body = held_unit_bar(3, 0);
  const double W = body.residual(0, 0);
  // static: H = 1 + further; W (1 - 1 / (1 + i eta))
  const DroppedDamping dropped = dropped_residual_damping({{&body, 0, 0, 0.1}}, 1, {0.});
  EXPECT_NEAR(dropped.change, W * 0.1 / std::sqrt(1.01) / 2, 1e-12);
  EXPECT_EQ(dropped_residual_damping({{&body, 0, 0, 0}}, 0, {0.3}).change, 0);
}
