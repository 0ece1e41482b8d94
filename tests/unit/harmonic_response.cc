// What bodies answer to forces that repeat themselves: against the receptances of two modes written out, and its derivative
// against differences.

#include "flutter.h"

#include <vibrocontact/analyses/limit_cycle/harmonic_response.h>
#include <vibrocontact/coupled_bodies/moving_shapes.h>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

using namespace vibrocontact;

namespace
{
  /// Two points, the second one on the mass, at a frequency between its own.
  struct RepeatedForces
  {
    static constexpr unsigned int n_harmonics = 2;
    static constexpr double omega = 6000, speed = 0.01;
    ContactPair pair;
    PatchShapes shapes = shapes_of_steps(pair);
    HarmonicResponse response{pair,   creep_schemes().front(), speed,
                              shapes, {1, Flutter::middle},    n_harmonics};
    DenseMatrix R = some_forces();

    explicit RepeatedForces(const ContactPair &pair = Flutter::pair(5e-4)) : pair(pair) {}

  private:
    static DenseMatrix some_forces()
    {
      DenseMatrix result(6, 2 * n_harmonics + 1);
      for (unsigned int k = 0; k < result.n(); ++k)
        for (unsigned int i = 0; i < result.m(); ++i)
          result(i, k) = std::sin(1. + 3 * i + 7 * k);
      return result;
    }
  };
} // namespace

TEST(HarmonicResponse, IsThatOfModesAndRest)
{
  RepeatedForces scene;
  const ContactPair &pair = scene.pair;
  const DenseMatrix &R = scene.R;
  scene.response.set_frequency(scene.omega);
  const DenseMatrix y = scene.response.response(R), q = scene.response.modal_amplitudes(R);
  for (unsigned int k = 0; k <= scene.n_harmonics; ++k)
  {
    const ComplexMatrix of_order = scene.response.of_order(k);
    const auto number = [k](const DenseMatrix &of, const unsigned int i) {
      return k == 0 ? std::complex<double>(of(i, 0)) : std::complex<double>(of(i, 2 * k - 1), of(i, 2 * k));
    };
    const std::complex<double> s(0, k * scene.omega);
    // of the point that the modes move: it is the second one, its column upstream the first
    std::complex<double> normal = pair.residual(0, 0) * number(R, 1), lateral = 0;
    for (unsigned int n = 0; n < 2; ++n)
    {
      const double w = pair.omega[n];
      const std::complex<double> amplitude =
          (pair.trace(Flutter::middle, n) * number(R, 1) + pair.trace(Flutter::lateral, n) * number(R, 5)) /
          (w * w + s * s + 2 * pair.damping_ratio[n] * w * s);
      EXPECT_NEAR(std::abs(number(q, n) - amplitude), 0, 1e-12 * std::abs(amplitude));
      normal += pair.trace(Flutter::middle, n) * amplitude;
      lateral += pair.trace(Flutter::lateral, n) * amplitude;
    }
    // V d/dx of the lateral displacements by the first difference, and their rate
    const std::complex<double> own = lateral + pair.residual(0, 0) * number(R, 5),
                               upstream = pair.residual(0, 0) * number(R, 4),
                               slip = s * own + scene.speed * (own - upstream) / 1e-3;
    EXPECT_NEAR(std::abs(number(y, 1) - normal), 0, 1e-12 * std::abs(normal));
    EXPECT_NEAR(std::abs(number(y, 5) - slip), 0, 1e-10 * std::abs(slip));
    for (unsigned int i = 0; i < y.m(); ++i)
    {
      std::complex<double> sum = 0;
      for (unsigned int j = 0; j < y.m(); ++j)
        sum += of_order(i, j) * number(R, j);
      EXPECT_NEAR(std::abs(sum - number(y, i)), 0, 1e-12 * std::abs(sum));
    }
  }
}

static ContactPair flowing_poles()
{
  ContactPair pair = Flutter::pair(5e-4);
  Flutter::move_by_poles(pair, true);
  return pair;
}

TEST(HarmonicResponse, OfPolesIsTheirReceptance)
{
  RepeatedForces scene(flowing_poles());
  const ContactPair &pair = scene.pair;
  scene.response.set_frequency(scene.omega);
  constexpr unsigned int k = 1;
  const std::complex<double> s(0, k * scene.omega);
  const ComplexMatrix found = scene.response.of_order(k), G = receptance(pair, k * scene.omega);
  // a lateral force on the mass: its gap, and its slip with V d/dx by the gradients and the first difference of what moves with it
  const unsigned int from = Flutter::lateral, upstream = 2 * Flutter::n_points + 1;
  std::complex<double> gradient = pair.residual_gradient(from, from);
  for (unsigned int p = 0; p < pair.n_poles(); ++p)
    gradient += pair.gradient(from, p) * pair.left(from, p) / (s - pair.poles[p]) +
                std::conj(pair.gradient(from, p) * pair.left(from, p)) / (s - std::conj(pair.poles[p]));
  const std::complex<double> slip =
      s * G(from, from) + scene.speed * (gradient + (G(from, from) - G(upstream, from)) / 1e-3);
  EXPECT_NEAR(std::abs(found(1, 5) - G(Flutter::middle, from)), 0,
              1e-10 * std::abs(G(Flutter::middle, from)));
  EXPECT_NEAR(std::abs(found(5, 5) - slip), 0, 1e-10 * std::abs(slip));
}

TEST(HarmonicResponse, SlopeIsThatOfDifferences)
{
  for (const ContactPair &pair : {Flutter::pair(5e-4), flowing_poles()})
  {
    RepeatedForces scene(pair);
    HarmonicResponse &response = scene.response;
    const DenseMatrix &R = scene.R;
    const double change = 1e-3;
    response.set_frequency(scene.omega + change);
    DenseMatrix difference = response.response(R), of_rest = response.rate_of_rest(R);
    response.set_frequency(scene.omega - change);
    difference.add(-1., response.response(R));
    of_rest.add(-1., response.rate_of_rest(R));
    response.set_frequency(scene.omega);
    difference /= 2 * change;
    of_rest /= 2 * change;
    const double size = difference.frobenius_norm(), size_of_rest = of_rest.frobenius_norm();
    difference.add(-1., response.response_slope(R));
    of_rest.add(-1., response.rate_of_rest_slope(R));
    EXPECT_LT(difference.frobenius_norm(), 1e-6 * size);
    EXPECT_LT(of_rest.frobenius_norm(), 1e-6 * size_of_rest);
  }
}
