// One step of one mode: closed forms for any damping, order of the theta method, its energy and its damping.

#include <vibrocontact/propagators/modal_step.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;

namespace
{
  constexpr auto linear = ReactionWeighting::as_other_forces;

  /// q at time 1 under p(t) = 1 - t / 2 from q = 0.3, v = -2
  double end(const double omega, const double zeta, const unsigned int n, const double theta)
  {
    const double h = 1. / n;
    const ModalStep s =
        theta < 0 ? exact_step(omega, zeta, h, linear) : theta_step(omega, zeta, theta, h, linear);
    double q = 0.3, v = -2;
    for (unsigned int k = 0; k < n; ++k)
    {
      const double p0 = 1 - 0.5 * k * h, p1 = 1 - 0.5 * (k + 1) * h;
      const double q1 = s.T[0][0] * q + s.T[0][1] * v + s.g0[0] * p0 + s.g1[0] * p1;
      v = s.T[1][0] * q + s.T[1][1] * v + s.g0[1] * p0 + s.g1[1] * p1;
      q = q1;
    }
    return q;
  }

  double closed_form(const double w, const double zeta)
  {
    const double t = 1;
    if (w == 0)
      return 0.3 - 2 * t + t * t / 2 - t * t * t / 12;
    // particular solution a + b t
    const double b = -0.5 / (w * w), a = (1 - 2 * zeta * w * b) / (w * w);
    const double q0 = 0.3 - a, v0 = -2 - b;
    double free = 0;
    if (zeta < 1)
    {
      const double wd = w * std::sqrt(1 - zeta * zeta);
      free = std::exp(-zeta * w * t) * (q0 * std::cos(wd * t) + (v0 + zeta * w * q0) / wd * std::sin(wd * t));
    }
    else if (zeta == 1)
      free = std::exp(-w * t) * (q0 + (v0 + w * q0) * t);
    else
    {
      const double wd = w * std::sqrt(zeta * zeta - 1);
      free =
          std::exp(-zeta * w * t) * (q0 * std::cosh(wd * t) + (v0 + zeta * w * q0) / wd * std::sinh(wd * t));
    }
    return free + a + b * t;
  }
} // namespace

TEST(ModalStep, ExactForAnyDampingAndStep)
{
  for (const double omega : {0., 0.1, 3., 400.})
    for (const double zeta : {0., 0.01, 1., 2.})
      for (const unsigned int n : {1u, 7u, 100u})
        EXPECT_NEAR(end(omega, omega == 0 ? 0 : zeta, n, -1), closed_form(omega, omega == 0 ? 0 : zeta),
                    1e-12)
            << omega << " " << zeta << " " << n;
}

TEST(ModalStep, ThetaMethodConverges)
{
  const double exact = closed_form(5, 0.02);
  for (const double theta : {0.5, 0.6, 1.})
  {
    const double coarse = std::abs(end(5, 0.02, 200, theta) - exact),
                 fine = std::abs(end(5, 0.02, 400, theta) - exact);
    EXPECT_NEAR(std::log2(coarse / fine), theta == 0.5 ? 2 : 1, 0.05) << theta;
  }
}

TEST(ModalStep, ThetaOneHalfKeepsTheEnergyAndMoreDampsAsStated)
{
  const double omega = 2000, h = 1e-5;
  for (const double theta : {0.5, 0.55, 1.})
  {
    const ModalStep s = theta_step(omega, 0, theta, h, linear);
    double q = 1, v = 0;
    const auto energy = [&]() { return 0.5 * (v * v + omega * omega * q * q); };
    const double start = energy();
    const unsigned int n = 1000;
    for (unsigned int k = 0; k < n; ++k)
    {
      const double q1 = s.T[0][0] * q + s.T[0][1] * v;
      v = s.T[1][0] * q + s.T[1][1] * v;
      q = q1;
    }
    const double rate = std::log(energy() / start) / (2 * n * h);
    EXPECT_NEAR(rate, -(theta - 0.5) * omega * omega * h, 1e-9 + 0.02 * (theta - 0.5) * omega * omega * h);
  }
}

TEST(ModalStep, ForceAtTheEndOfTheStep)
{
  const ModalStep s = exact_step(0, 0, 0.1, ReactionWeighting::end_of_step);
  EXPECT_NEAR(s.g1[0], 0.005, 1e-15);
  EXPECT_NEAR(s.g1[1], 0.1, 1e-15);
  EXPECT_EQ(s.g0[0], 0.);
}
