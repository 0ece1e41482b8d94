// Refinable functions against closed forms: exact rationals of connection coefficients, splines, Fourier transforms.
#include "pi.h"

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/numerics/refinable_function.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;

namespace
{
  double value(const RefinableFunction &phi, const double x, const unsigned int d)
  {
    const double cell = std::floor(x);
    if (cell < 0 || cell >= phi.support())
      return 0;
    return phi.values(x - cell, d)[static_cast<unsigned int>(cell)];
  }

  /// Cubic B-spline by truncated powers, d-th derivative.
  double cubic(const double x, const unsigned int d)
  {
    const double binomial[] = {1, -4, 6, -4, 1}, factor[] = {1. / 6, 0.5, 1, 1};
    double sum = 0;
    for (int k = 0; k <= 4; ++k)
      if (x >= k)
        sum += binomial[k] * factor[d] * std::pow(x - k, 3. - d);
    return sum;
  }

  std::complex<double> sinc_power(const double omega, const unsigned int n)
  {
    const double x = omega / 2, s = x == 0 ? 1 : std::sin(x) / x;
    return std::pow(s, n) * std::polar(1., -x * n);
  }

  void expect_sum_rules(const RefinableFunction &phi, const RefinableFunction &chi, const unsigned int d,
                        const double tolerance)
  {
    const auto G = connection_coefficients(phi, chi, d);
    for (unsigned int i = 0; i <= d; ++i)
    {
      double sum = 0;
      for (unsigned int n = 0; n < G.values.size(); ++n)
        sum += std::pow(G.first + static_cast<int>(n), i) * G.values[n];
      EXPECT_NEAR(sum, i == d ? std::tgamma(d + 1.) : 0., tolerance);
    }
  }
} // namespace

TEST(RefinableFunction, SplinesAreThePiecewisePolynomials)
{
  const auto phi = b_spline(4);
  for (unsigned int d = 0; d <= 3; ++d)
    for (double x = 0; x < 4; x += 0.0371)
      EXPECT_NEAR(value(phi, x, d), cubic(x, d), 1e-13) << x << " " << d;
  const auto haar = b_spline(1);
  EXPECT_EQ(value(haar, 0., 0), 1.);
  EXPECT_EQ(value(haar, 0.7, 0), 1.);
  EXPECT_EQ(value(haar, 1., 0), 0.);
  EXPECT_FALSE(haar.has_values(1));
}

TEST(RefinableFunction, SixDaubechiesCoefficientsAreTheClosedForm)
{
  const auto phi = daubechies(6);
  const double r = std::sqrt(10.), s = std::sqrt(5 + 2 * r);
  const double p[] = {1 + r + s,          5 + r + 3 * s, 10 - 2 * r + 2 * s,
                      10 - 2 * r - 2 * s, 5 + r - 3 * s, 1 + r - s};
  for (unsigned int i = 0; i < 6; ++i)
    EXPECT_NEAR(phi.coefficients()[i], p[i] / 16, 1e-15);
  // partition of unity, derivatives of the linear functions, refinement equation; at dyadic points, as round-off in x
  // is not small to the power 0.09 of the derivative
  for (double x = 0; x < 1; x += 17. / 1024)
  {
    double sum = 0, slope = 0, zero = 0;
    for (int k = 0; k < 5; ++k)
    {
      sum += value(phi, x + k, 0);
      zero += value(phi, x + k, 1);
      slope -= k * value(phi, x + k, 1);
      for (unsigned int d = 0; d < 2; ++d)
      {
        double refined = 0;
        for (int i = 0; i < 6; ++i)
          refined += std::pow(2., d) * p[i] / 16 * value(phi, 2 * (x + k) - i, d);
        EXPECT_NEAR(value(phi, x + k, d), refined, 1e-12);
      }
    }
    EXPECT_NEAR(sum, 1, 1e-14);
    EXPECT_NEAR(zero, 0, 1e-13);
    EXPECT_NEAR(slope, 1, 1e-13);
  }
  // there is a continuous first derivative, no second one
  EXPECT_TRUE(phi.has_values(1));
  EXPECT_FALSE(phi.has_values(2));
}

TEST(RefinableFunction, SmoothnessIsThePublishedOne)
{
  EXPECT_NEAR(b_spline(1).smoothness(), 0.5, 1e-12);
  EXPECT_NEAR(b_spline(4).smoothness(), 3.5, 1e-12);
  // Eirola 1992
  EXPECT_NEAR(daubechies(4).smoothness(), 1.000, 1e-3);
  EXPECT_NEAR(daubechies(6).smoothness(), 1.415, 1e-3);
  EXPECT_NEAR(daubechies(8).smoothness(), 1.775, 1e-3);
  EXPECT_NEAR(daubechies(10).smoothness(), 2.096, 1e-3);
  EXPECT_NEAR(daubechies(12).smoothness(), 2.388, 1e-3);
  // Hoelder exponents 1.62, 1.97, 2.19 (Daubechies 1992)
  EXPECT_FALSE(daubechies(8).has_values(2));
  EXPECT_FALSE(daubechies(10).has_values(2));
  EXPECT_TRUE(daubechies(12).has_values(2));
}

TEST(RefinableFunction, FourierTransforms)
{
  for (const unsigned int n : {1, 4})
    for (const double omega : {0., 0.3, -2.2, 7., 31.4})
      EXPECT_LT(std::abs(b_spline(n).fourier_transform(omega) - sinc_power(omega, n)), 1e-14);
  // shifts of an orthogonal function: sum |phi^(omega + 2 pi l)|^2 = 1; by the tail's decay of omega^-2.8
  double sum = 0;
  for (int l = -1000; l <= 1000; ++l)
    sum += std::norm(daubechies(6).fourier_transform(0.7 + 2 * pi * l));
  EXPECT_NEAR(sum, 1, 1e-6);
}

TEST(ConnectionCoefficients, SixDaubechiesCoefficientsAreTheRationals)
{
  const auto phi = daubechies(6);
  const double first[] = {0, 272. / 365, -53. / 365, 16. / 1095, 1. / 2920},
               second[] = {-295. / 56, 356. / 105, -92. / 105, 4. / 35, 3. / 560};
  const auto G0 = connection_coefficients(phi, phi, 0), G1 = connection_coefficients(phi, phi, 1),
             G2 = connection_coefficients(phi, phi, 2);
  for (int k = -6; k <= 6; ++k)
  {
    const int n = std::abs(k);
    EXPECT_NEAR(G0(k), k == 0, 1e-13);
    EXPECT_NEAR(G1(k), n > 4 ? 0 : (k < 0 ? -first[n] : first[n]), 1e-13);
    EXPECT_NEAR(G2(k), n > 4 ? 0 : second[n], 1e-13);
  }
}

TEST(ConnectionCoefficients, CubicSplinesAreTheSplineOfOrderEight)
{
  // int B(x) B(x - k) and derivatives are the values at the integers of the spline of twice the order
  const double G0[] = {151. / 315, 397. / 1680, 1. / 42, 1. / 5040}, G1[] = {0, 49. / 144, 7. / 90, 1. / 720},
               G2[] = {-2. / 3, 1. / 8, 1. / 5, 1. / 120};
  const auto phi = b_spline(4);
  const auto g0 = connection_coefficients(phi, phi, 0), g1 = connection_coefficients(phi, phi, 1),
             g2 = connection_coefficients(phi, phi, 2);
  for (int k = -4; k <= 4; ++k)
  {
    const int n = std::abs(k), sign = k < 0 ? -1 : 1;
    EXPECT_NEAR(g0(k), n < 4 ? G0[n] : 0, 1e-14);
    EXPECT_NEAR(g1(k), n < 4 ? sign * G1[n] : 0, 1e-14);
    EXPECT_NEAR(g2(k), n < 4 ? G2[n] : 0, 1e-14);
  }
  // Haar in the trial's place: int over a cell [k, k + 1) of the spline and of its second derivative
  const auto h0 = connection_coefficients(b_spline(1), phi, 0),
             h2 = connection_coefficients(b_spline(1), phi, 2);
  const double H0[] = {1. / 24, 11. / 24, 11. / 24, 1. / 24}, H2[] = {0.5, -0.5, -0.5, 0.5};
  for (int k = 0; k < 4; ++k)
  {
    EXPECT_NEAR(h0(k), H0[k], 1e-14);
    EXPECT_NEAR(h2(k), H2[k], 1e-14);
  }
}

TEST(ConnectionCoefficients, SumRulesBetweenAnyTwo)
{
  for (unsigned int L = 6; L <= 38; L += 2)
    for (unsigned int d = 0; d <= 2; ++d)
    {
      const auto phi = daubechies(L);
      expect_sum_rules(phi, phi, d, 1e-10);
      expect_sum_rules(phi, b_spline(4), d, 1e-10);
      expect_sum_rules(b_spline(1), phi, d, 1e-10);
      // orthonormal shifts
      if (d == 0)
        for (int k = 0; k < static_cast<int>(L); ++k)
          EXPECT_NEAR(connection_coefficients(phi, phi, 0)(k), k == 0, 1e-10) << L;
    }
}

TEST(ConnectionCoefficients, OneWhereverTheDerivativesStand)
{
  // int chi phi^(d)(. - k) = (-1)^d int chi^(d) phi(. - k), the recursion with the functions exchanged: strong and
  // distributional form
  const std::vector<RefinableFunction> functions{b_spline(1), b_spline(4), daubechies(6), daubechies(10),
                                                 daubechies(18)};
  for (const auto &phi : functions)
    for (const auto &chi : functions)
      for (unsigned int d = 0; d <= 2; ++d)
      {
        // Haar by Haar, and its second derivative by six coefficients, do not exist
        if (phi.smoothness() + chi.smoothness() < d + 0.1)
          continue;
        const auto strong = connection_coefficients(phi, chi, d),
                   distributional = connection_coefficients(chi, phi, d);
        for (int k = -20; k <= 20; ++k)
          EXPECT_NEAR(strong(k), (d == 1 ? -1 : 1) * distributional(-k), 1e-12);
      }
}

TEST(ConnectionCoefficients, RefusedWhereTheRecursionDoesNotDetermineThem)
{
  EXPECT_NO_THROW(connection_coefficients(daubechies(4), daubechies(4), 1));
  EXPECT_THROW(connection_coefficients(daubechies(4), daubechies(4), 2), InputError);
  EXPECT_THROW(connection_coefficients(b_spline(1), b_spline(1), 1), InputError);
  EXPECT_THROW(daubechies(5), InputError);
  EXPECT_THROW(daubechies(40), InputError);
}
