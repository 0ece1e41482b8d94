// Poles near receptances: of a viscous body exactly, of one with hysteretic losses near it; elastic at rest.

#include <vibrocontact/bodies/receptance_fit.h>
#include <vibrocontact/numerics/least_squares.h>

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
