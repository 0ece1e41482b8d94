// Poles that stand for receptances: of a viscous body exactly, of one with hysteretic losses near it, passive, elastic at rest.

#include <vibrocontact/bodies/receptance_fit.h>

#include <deal.II/base/numbers.h>

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

using namespace vibrocontact;
using dealii::numbers::PI;
using Complex = std::complex<double>;

namespace
{
  /// Three modes of two rows over 20 to 2000 Hz.
  ReceptanceLines lines_of(const bool hysteretic, DenseMatrix &at_rest)
  {
    const double omega[3] = {2 * PI * 90, 2 * PI * 400, 2 * PI * 1100}, loss[3] = {0.9, 0.1, 0.03},
                 shapes[3][2] = {{1, 0.4}, {-0.3, 1}, {0.7, -0.8}};
    ReceptanceLines lines;
    at_rest.reinit(2, 2);
    for (unsigned int k = 0; k < 80; ++k)
    {
      const double w = 2 * PI * 20 * std::pow(100., k / 79.);
      ComplexMatrix G(2, 2);
      for (unsigned int m = 0; m < 3; ++m)
      {
        const double w_m = omega[m];
        const Complex d = w_m * w_m - w * w + Complex(0, loss[m]) * w_m * (hysteretic ? w_m : w);
        for (unsigned int i = 0; i < 2; ++i)
          for (unsigned int j = 0; j < 2; ++j)
          {
            G(i, j) += shapes[m][i] * shapes[m][j] / d;
            at_rest(i, j) += k == 0 ? shapes[m][i] * shapes[m][j] / (w_m * w_m) : 0.;
          }
      }
      lines.omega.push_back(w);
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

TEST(ReceptanceFit, HystereticBodyIsFollowedByPassivePolesAndElasticAtRest)
{
  DenseMatrix at_rest;
  const ReceptanceLines lines = lines_of(true, at_rest);
  double before = 1;
  for (const unsigned int n_pairs : {4u, 8u, 12u})
  {
    const ReceptanceFit fit = fit_receptance(lines, at_rest, small(), n_pairs);
    std::cout << n_pairs << " pairs: worst error " << fit.worst_error() << ", gain before "
              << fit.passivity.gain_before << ", change " << fit.passivity.change << std::endl;
    EXPECT_LT(fit.worst_error(), before);
    before = fit.worst_error();
    EXPECT_TRUE(fit.passivity.is_passive());
    EXPECT_LT(at_rest_error(fit.body, at_rest), 1e-12);
    // the whole, its slow part included, takes energy far below and above the lines, too
    for (double f = 1e-3; f < 1e6; f *= 1.3)
    {
      const ComplexMatrix G = receptance(fit.body, 2 * PI * f);
      const double a = G(0, 0).imag(), b = G(1, 1).imag(), c = (G(0, 1) + G(1, 0)).imag() / 2,
                   largest = (a + b) / 2 + std::hypot((a - b) / 2, c);
      EXPECT_LT(largest, 1e-6 * std::abs(G(0, 0))) << f;
    }
  }
  EXPECT_LT(before, 2e-2);
}
