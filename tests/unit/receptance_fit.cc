// Poles near receptances: of a viscous body exactly, of one with hysteretic losses near it; elastic at rest.

#include <vibrocontact/bodies/passivity_test.h>
#include <vibrocontact/bodies/receptance_fit.h>
#include <vibrocontact/numerics/eigenvalues.h>

#include <deal.II/base/numbers.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

using namespace vibrocontact;
using dealii::numbers::PI;
using Complex = std::complex<double>;

namespace
{
  /// Three modes of two rows over 20 to 2000 Hz, with nine lines more in each band.
  ReceptanceLines lines_of(const bool hysteretic, DenseMatrix &at_rest,
                           const std::vector<FrequencyBand> &bands = {})
  {
    const double omega[3] = {2 * PI * 90, 2 * PI * 400, 2 * PI * 1100}, loss[3] = {0.9, 0.1, 0.03},
                 shapes[3][2] = {{1, 0.4}, {-0.3, 1}, {0.7, -0.8}};
    ReceptanceLines lines;
    at_rest.reinit(2, 2);
    for (unsigned int k = 0; k < 80; ++k)
      lines.omega.push_back(2 * PI * 20 * std::pow(100., k / 79.));
    for (const FrequencyBand &band : bands)
      for (unsigned int k = 0; k < 9; ++k)
        lines.omega.push_back(band.from + (band.to - band.from) * k / 8);
    std::sort(lines.omega.begin(), lines.omega.end());
    at_rest = 0;
    for (unsigned int m = 0; m < 3; ++m)
      for (unsigned int i = 0; i < 4; ++i)
        at_rest(i / 2, i % 2) += shapes[m][i / 2] * shapes[m][i % 2] / (omega[m] * omega[m]);
    for (const double w : lines.omega)
    {
      ComplexMatrix G(2, 2);
      for (unsigned int m = 0; m < 3; ++m)
      {
        const double w_m = omega[m];
        const Complex d = w_m * w_m - w * w + Complex(0, loss[m]) * w_m * (hysteretic ? w_m : w);
        for (unsigned int i = 0; i < 2; ++i)
          for (unsigned int j = 0; j < 2; ++j)
            G(i, j) += shapes[m][i] * shapes[m][j] / d;
      }
      lines.values.push_back(G);
    }
    return lines;
  }

  /// hardly anything follows at once
  DenseMatrix small()
  {
    DenseMatrix D(2, 2);
    D(0, 0) = D(1, 1) = 1e-16;
    return D;
  }

  double at_rest_error(const BodyInContact &body, const DenseMatrix &expected)
  {
    DenseMatrix G = sum_over_poles(body, static_weights(body));
    G.add(1., body.residual);
    G.add(-1., expected);
    return G.frobenius_norm() / expected.frobenius_norm();
  }
} // namespace

TEST(ReceptanceFit, ViscousBodyIsFoundAgain)
{
  DenseMatrix at_rest;
  const ReceptanceLines lines = lines_of(false, at_rest);
  const ReceptanceFit fit = fit_receptance(lines, at_rest, small(), 3);
  std::cout << "worst error " << fit.worst_error() << std::endl;
  EXPECT_LT(fit.worst_error(), 1e-8);
  EXPECT_LT(at_rest_error(fit.body, at_rest), 1e-12);
}

TEST(ReceptanceFit, HystereticBodyIsFollowedAndElasticAtRest)
{
  DenseMatrix at_rest;
  const ReceptanceLines lines = lines_of(true, at_rest);
  const ReceptanceFit fit = fit_receptance(lines, at_rest, small(), 8);
  double missed = 0, whole = 0;
  // where lines count in full
  for (unsigned int l = 0; l < lines.omega.size(); ++l)
    for (unsigned int i = 0; i < 2 && lines.omega[l] > 2 * PI * 100; ++i)
      for (unsigned int j = 0; j < 2; ++j)
      {
        missed += std::norm(receptance(fit.body, lines.omega[l])(i, j) - lines.values[l](i, j));
        whole += std::norm(lines.values[l](i, j));
      }
  std::cout << "rms error " << std::sqrt(missed / whole) << std::endl;
  EXPECT_LT(std::sqrt(missed / whole), 0.1);
  EXPECT_LT(at_rest_error(fit.body, at_rest), 1e-9);
  EXPECT_GT(definiteness(fit.body.residual), 0);
}

TEST(PassivityTest, CrossingsOfTwoModesInClosedForm)
{
  // a damped mode, and one that gives energy where it outweighs the first:
  // Im G = 2 w (-d1 / |D1|^2 + d2 b / |D2|^2), zero where d1 |D2|^2 = d2 b |D1|^2, a quadratic equation for w^2
  const double w1 = 1000, d1 = 40, w2 = 1300, d2 = 10, b = 0.3;
  BodyInContact body;
  body.residual.reinit(1, 1);
  body.right.reinit(1, 2);
  body.left.reinit(1, 2);
  const double rate[2] = {-d1, -d2}, frequency[2] = {w1, w2}, size[2] = {1, -b};
  for (unsigned int k = 0; k < 2; ++k)
  {
    const Complex pole(rate[k], std::sqrt(frequency[k] * frequency[k] - rate[k] * rate[k]));
    body.poles.push_back(pole);
    body.right(0, k) = 1;
    body.left(0, k) = size[k] / Complex(0, 2 * pole.imag());
  }
  body.pole_load.assign(2, 0.);
  const auto square = [](const double w_k, const double d, const double x)
  { return (w_k * w_k - x) * (w_k * w_k - x) + 4 * d * d * x; };
  const auto surplus = [&](const double x) { return d1 * square(w2, d2, x) - d2 * b * square(w1, d1, x); };
  // coefficients by three values
  const double c0 = surplus(0), c2 = (surplus(2e6) - 2 * surplus(1e6) + c0) / 2e12,
               c1 = (surplus(1e6) - c0) / 1e6 - c2 * 1e6, root = std::sqrt(c1 * c1 - 4 * c2 * c0);
  const std::vector<double> expected = {std::sqrt((-c1 - root) / (2 * c2)),
                                        std::sqrt((-c1 + root) / (2 * c2))};
  const PassivityTest test = test_passivity(body);
  ASSERT_EQ(test.crossings.size(), 2u);
  for (unsigned int k = 0; k < 2; ++k)
    EXPECT_NEAR(test.crossings[k], expected[k], 1e-8 * expected[k]);
  ASSERT_EQ(test.active.size(), 1u);
  EXPECT_GT(test.active[0], expected[0]);
  EXPECT_LT(test.active[0], expected[1]);
  body.left(0, 1) *= -1.;
  EXPECT_TRUE(test_passivity(body).is_passive());
}

TEST(ReceptanceFit, InTimeItIsPassiveElasticAtRestAndRightInItsBands)
{
  // a part follows at once, as under every patch of a contact
  DenseMatrix at_rest, at_once(2, 2);
  const std::vector<FrequencyBand> bands = {{2 * PI * 392, 2 * PI * 408}, {2 * PI * 1078, 2 * PI * 1122}};
  ReceptanceLines lines = lines_of(true, at_rest, bands);
  at_once(0, 0) = at_once(1, 1) = 0.3 * at_rest(0, 0);
  at_rest.add(1., at_once);
  for (ComplexMatrix &G : lines.values)
    for (unsigned int i = 0; i < 2; ++i)
      G(i, i) += at_once(i, i);
  const ReceptanceFit fit = passive_receptance_fit(lines, bands, at_rest, at_once, 8);
  EXPECT_TRUE(fit.passive);
  EXPECT_LT(at_rest_error(fit.body, at_rest), 1e-9);
  double inside = 0, outside = 0;
  for (unsigned int l = 0; l < lines.omega.size(); ++l)
  {
    double &worst = bands[0].holds(lines.omega[l]) || bands[1].holds(lines.omega[l]) ? inside : outside;
    worst = std::max(worst, fit.error[l]);
    // no force takes energy from it, seen without the test
    DenseMatrix imaginary(2, 2), vectors;
    const ComplexMatrix G = receptance(fit.body, lines.omega[l]);
    for (unsigned int i = 0; i < 4; ++i)
      imaginary(i / 2, i % 2) = G(i / 2, i % 2).imag();
    EXPECT_LT(symmetric_eigenvalues(imaginary, vectors).back(), 0.);
  }
  std::cout << "error in the bands " << inside << ", elsewhere " << outside << std::endl;
  EXPECT_LT(inside, 0.03);
  EXPECT_LT(inside, outside / 10);
}
