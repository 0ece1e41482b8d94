// Periodic motions by weighted residuals: derivatives of the equation, closed forms without contact, work against losses,
// friction against Den Hartog's oscillator, bases against each other.

#include "axial_bar.h"

#include <vibrocontact/analyses/periodic/periodic_error.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/contact/laws/normal_laws.h>

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>

using namespace vibrocontact;

namespace
{
  std::shared_ptr<const NormalLaw> penalty(const AxialBarCase &c)
  {
    return create_normal_law("exponential penalty", {c.amplitude, c.exponent});
  }

  BalanceSettings pair(const std::string &trial, const std::string &weighting, const unsigned int n)
  {
    BalanceSettings settings;
    settings.trial = trial;
    settings.weighting = weighting;
    settings.n_functions = n;
    return settings;
  }

  /// A point on springs with three coupled directions above a stop
  ForcedBody three_directions(const unsigned int n_points)
  {
    ForcedBody body;
    const unsigned int n = 3 * n_points, m = 5;
    body.rows_per_point = 3;
    body.trace.reinit(n + 1, m);
    body.residual.reinit(n + 1, n + 1);
    body.force_row = n;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-1, 1);
    for (unsigned int k = 0; k < m; ++k)
    {
      body.omega.push_back(2 + 1.7 * k);
      body.damping_ratio.push_back(0.03);
      body.trace(n, k) = number(random);
      body.modal_load.push_back(0.1 * number(random));
      for (unsigned int i = 0; i < n; ++i)
        body.trace(i, k) = number(random);
    }
    for (unsigned int i = 0; i < n; ++i)
      body.residual(i, i) = 0.02;
    body.residual_load.assign(n + 1, 0.);
    body.relaxation = 1e-3;
    body.gap.assign(n_points, 0.05);
    return body;
  }

  void expect_right_derivatives(PeriodicBalance &balance, const HarmonicForce &force)
  {
    balance.set_force(force);
    const unsigned int n = balance.n_unknowns();
    std::mt19937 random(3);
    std::normal_distribution<double> number;
    std::vector<double> c(n), direction(n), plus, minus, by_frequency;
    for (unsigned int k = 0; k < n; ++k)
    {
      c[k] = 0.2 * number(random);
      direction[k] = number(random);
    }
    DenseMatrix jacobian;
    std::vector<double> residual;
    balance.evaluate(c, residual, &jacobian, &by_frequency);
    const auto shifted = [&](const double h)
    {
      std::vector<double> x = c;
      for (unsigned int k = 0; k < n; ++k)
        x[k] += h * direction[k];
      balance.evaluate(x, residual, nullptr, nullptr);
      return residual;
    };
    const double h = 1e-7;
    plus = shifted(h);
    minus = shifted(-h);
    double size = 0, error = 0;
    for (unsigned int i = 0; i < n; ++i)
    {
      double sum = 0;
      for (unsigned int k = 0; k < n; ++k)
        sum += jacobian(i, k) * direction[k];
      size = std::max(size, std::abs(sum));
      error = std::max(error, std::abs(sum - (plus[i] - minus[i]) / (2 * h)));
    }
    // the samples of a law with kinks change sides between the two
    EXPECT_LT(error, 2e-5 * size);

    HarmonicForce other = force;
    const double df = 1e-6 * force.frequency;
    other.frequency = force.frequency + df;
    balance.set_force(other);
    balance.evaluate(c, plus, nullptr, nullptr);
    other.frequency = force.frequency - df;
    balance.set_force(other);
    balance.evaluate(c, minus, nullptr, nullptr);
    size = error = 0;
    for (unsigned int i = 0; i < n; ++i)
    {
      size = std::max(size, std::abs(by_frequency[i]));
      error = std::max(error, std::abs(by_frequency[i] - (plus[i] - minus[i]) / (2 * df)));
    }
    EXPECT_LT(error, 2e-5 * size);
  }
} // namespace

TEST(PeriodicBalance, DerivativesAreThoseOfTheResidual)
{
  for (const char *basis : {"fourier", "bspline", "daubechies6"})
    for (const unsigned int n : {9u, 8u})
      for (const auto &law :
           {create_normal_law("exponential penalty", {3., 2.}), create_normal_law("signorini")})
      {
        SCOPED_TRACE(std::string(basis) + " " + std::to_string(n) + " " + law->description().name);
        BalanceSettings settings = pair(basis, basis, n);
        settings.n_samples = 1024;
        settings.friction = 0.3;
        for (const double relaxation : {1e-3, 0.})
        {
          ForcedBody body = three_directions(2);
          body.relaxation = relaxation;
          PeriodicBalance balance(body, law, settings);
          expect_right_derivatives(balance, {1., 0.4});
        }
      }
}

// Pairs that Newton's method finds neither from rest nor over the gap: solutions to rounding, as near to shooting as N cells are.
TEST(PeriodicBalance, HaarIsFoundThroughSofterLaws)
{
  const AxialBarCase c = axial_bar_1275();
  const PeriodicReference reference = periodic_reference(axial_bar(c), penalty(c), c.excitation(), 4096);
  for (const auto &[n, error] : {std::pair(8u, 0.5), std::pair(9u, 0.5)})
  {
    BalanceSettings settings = pair("haar", "fourier", n);
    PeriodicBalance balance(axial_bar(c), penalty(c), settings);
    balance.set_force(c.excitation());
    const PeriodicSolution solution = balance.solve();
    ASSERT_TRUE(solution.converged) << n;
    EXPECT_GT(solution.stiffness_steps, 0u);
    // the law asked for, not the softened one
    std::vector<double> residual;
    balance.evaluate(solution.force, residual, nullptr, nullptr);
    double size = 0;
    for (const double value : residual)
      size += value * value;
    EXPECT_LT(std::sqrt(size), 1e-10 * balance.force_scale(solution.force));
    EXPECT_LT(errors_of(balance, solution, sample_motion(balance, solution, 4096), reference).displacement,
              error);
  }
}

// Den Hartog (1931): mass on a spring, dry friction R, force P cos(w t + phase); two sticks-free turning points per period. With
// x0 the amplitude, a = P / k, x_f = R / k, r = w / w_n:
//   x0^2 = a^2 V^2 - x_f^2 H^2,   V = 1 / (1 - r^2),   H = sin(pi / r) / (r (1 + cos(pi / r))).
namespace
{
  constexpr double spring = 100, mass = 1, exciting = 10;

  /// The oscillator, driven along the first tangential direction of a point that presses 10 N; behind it stops on both sides,
  /// each a point of its own whose normal direction is the motion.
  ForcedBody den_hartog(const bool stops, const double gap)
  {
    ForcedBody body;
    const unsigned int n_points = stops ? 3 : 1, n = 3 * n_points;
    body.rows_per_point = 3;
    body.omega = {std::sqrt(spring / mass)};
    body.damping_ratio = {0.};
    body.modal_load = {0.};
    body.trace.reinit(n, 1);
    body.trace(1, 0) = 1 / std::sqrt(mass);
    body.residual.reinit(n, n);
    body.residual(0, 0) = 1e-3;
    body.force_row = 1;
    body.residual_load.assign(n, 0.);
    body.gap = {-1e-3 * 10};
    if (stops)
    {
      body.trace(3, 0) = 1 / std::sqrt(mass);
      body.trace(6, 0) = -1 / std::sqrt(mass);
      body.gap.insert(body.gap.end(), {gap, gap});
    }
    return body;
  }

  double amplitude(const PeriodicMotion &motion)
  {
    double result = 0;
    for (const double x : motion.points[0].tangential_displacement[0])
      result = std::max(result, std::abs(x));
    return result;
  }
} // namespace

TEST(PeriodicBalance, DryFrictionAsDenHartog)
{
  const double k = spring, omega = std::sqrt(k / mass), P = exciting, mu_N = 3;
  for (const double ratio : {0.7, 1.4, 2.})
  {
    BalanceSettings settings = pair("fourier", "fourier", 201);
    settings.friction = mu_N / 10;
    settings.n_samples = 8192;
    PeriodicBalance balance(den_hartog(false, 0), create_normal_law("signorini"), settings);
    balance.set_force({P, ratio * omega / (2 * M_PI)});
    const PeriodicSolution solution = balance.solve();
    ASSERT_TRUE(solution.converged) << ratio;
    const PeriodicMotion motion = sample_motion(balance, solution, 4096);
    const double V = 1 / (1 - ratio * ratio),
                 H = std::sin(M_PI / ratio) / (ratio * (1 + std::cos(M_PI / ratio)));
    EXPECT_NEAR(amplitude(motion) / std::sqrt(std::pow(P / k * V, 2) - std::pow(mu_N / k * H, 2)), 1, 1e-3)
        << ratio;
    EXPECT_NEAR(motion.impulse[0] * ratio * omega / (2 * M_PI), 10, 1e-9);
  }
}

// Against steps so small that what they miss at a change of sliding direction does not count.
TEST(PeriodicBalance, DryFrictionAndStops)
{
  const double ratio = 0.9, gap = 0.12, stop = 200, mu_N = 1, omega = ratio * std::sqrt(spring / mass);
  const unsigned int per_period = 10000;
  const double h = 2 * M_PI / omega / per_period;
  const auto force = [&](const double t, const double x, const double v)
  {
    return exciting * std::sin(omega * t) - spring * x -
           (v > 0   ? mu_N
            : v < 0 ? -mu_N
                    : 0.) -
           stop * (std::max(x - gap, 0.) - std::max(-x - gap, 0.));
  };
  double x = 0, v = 0, largest = 0;
  for (unsigned int i = 0; i < 100 * per_period; ++i) // velocity Verlet
  {
    const double t = i * h, half = v + 0.5 * h * force(t, x, v) / mass;
    x += h * half;
    v = half + 0.5 * h * force(t + h, x, half) / mass;
    if (i >= 99 * per_period)
      largest = std::max(largest, std::abs(x));
  }
  BalanceSettings settings = pair("fourier", "fourier", 201);
  settings.friction = mu_N / 10;
  settings.n_samples = 8192;
  // the point that presses is on a spring, too: its load is not changed by that
  ForcedBody body = den_hartog(true, gap);
  body.gap[0] = -(10 / stop + 10 * 1e-3);
  PeriodicBalance balance(body, create_normal_law("linear spring", {stop, 1}), settings);
  balance.set_force({exciting, omega / (2 * M_PI)});
  const PeriodicSolution solution = balance.solve();
  ASSERT_TRUE(solution.converged);
  const PeriodicMotion motion = sample_motion(balance, solution, 4096);
  EXPECT_NEAR(motion.impulse[0] * omega / (2 * M_PI), 10, 1e-6);
  EXPECT_GT(motion.impulse[1], 0.1);
  EXPECT_NEAR(amplitude(motion) / largest, 1, 1e-3);
}

TEST(PeriodicBalance, BarWithoutContactSwingsAsTheClosedForm)
{
  for (const AxialBarCase &c : {axial_bar_150(), axial_bar_1275()})
    for (const char *basis : {"fourier", "bspline"})
    {
      ForcedBody body = axial_bar(c);
      body.gap[0] = 1;
      PeriodicBalance balance(body, penalty(c), pair(basis, basis, basis[0] == 'f' ? 7 : 255));
      balance.set_force(c.excitation());
      const PeriodicSolution solution = balance.solve();
      ASSERT_TRUE(solution.converged);
      EXPECT_EQ(solution.iterations, 0u);
      const PeriodicMotion motion = sample_motion(balance, solution, 4096);
      EXPECT_NEAR(motion.tip_max / c.linear_amplitude, 1, basis[0] == 'f' ? 1e-6 : 1e-5);
      EXPECT_NEAR(motion.tip_min / -c.linear_amplitude, 1, basis[0] == 'f' ? 1e-6 : 1e-5);
    }
  EXPECT_NEAR(axial_bar(axial_bar_150()).omega[0] / (2 * M_PI), 1273.147, 1273.147e-6);
}

TEST(PeriodicBalance, ForceDoesAsMuchWorkAsDampingTakes)
{
  const AxialBarCase c = axial_bar_1275();
  const ForcedBody body = axial_bar(c);
  PeriodicBalance balance(body, penalty(c), pair("fourier", "fourier", 127));
  balance.set_force(c.excitation());
  const PeriodicSolution solution = balance.solve();
  ASSERT_TRUE(solution.converged);
  const DenseMatrix q =
      modal_coefficients(body, balance.integrals(), solution.excitation, balance.body_forces(solution.force));
  // sine work F sin(w t) against u: pi F times the amplitude of -cos; loss of a harmonic q: period c (m w)^2 2 |q|^2
  const double f = c.frequency, work = -2 * M_PI * AxialBarCase::force * solution.displacement[1];
  double loss = 0;
  for (unsigned int k = 0; k < body.n_modes(); ++k)
    for (unsigned int m = 1; 2 * m < 127; ++m)
      loss += 2 * body.damping_ratio[k] * body.omega[k] * std::pow(2 * M_PI * m * f, 2) * 2 *
              (q(2 * m - 1, k) * q(2 * m - 1, k) + q(2 * m, k) * q(2 * m, k)) / f;
  // the exponential spring gives back what it takes, but for the harmonics beyond those kept
  // and what the rule of 4096 samples misses at its kinks
  EXPECT_NEAR(loss / std::abs(work), 1, 1e-5);
}

TEST(PeriodicBalance, EveryPairFindsTheSameMotion)
{
  const AxialBarCase c = axial_bar_1275();
  PeriodicBalance fine(axial_bar(c), penalty(c), pair("fourier", "fourier", 255));
  fine.set_force(c.excitation());
  const PeriodicSolution found = fine.solve();
  ASSERT_TRUE(found.converged);
  const PeriodicMotion reference = sample_motion(fine, found, 4096);
  const std::vector<std::tuple<std::string, std::string, double>> pairs = {
      {"fourier", "fourier", 1e-4},     {"bspline", "bspline", 1e-3}, {"daubechies6", "daubechies6", 3e-3},
      {"daubechies6", "fourier", 3e-2}, {"haar", "fourier", 4e-2},    {"haar", "bspline", 6e-2}};
  for (const auto &[trial, weighting, limit] : pairs)
  {
    PeriodicBalance balance(axial_bar(c), penalty(c), pair(trial, weighting, trial == "fourier" ? 63 : 64));
    balance.set_force(c.excitation());
    const PeriodicSolution solution = balance.solve();
    EXPECT_TRUE(solution.converged) << trial << ":" << weighting;
    const PeriodicMotion motion = sample_motion(balance, solution, 4096);
    const double error = relative_error(motion.points[0].displacement, reference.points[0].displacement);
    std::printf("%s:%s  %.3g, %u iterations, %u gap steps\n", trial.c_str(), weighting.c_str(), error,
                solution.iterations, solution.homotopy_steps);
    EXPECT_LT(error, limit) << trial << ":" << weighting;
  }
}

TEST(PeriodicBalance, MomentsOfAConstantAreThoseOfTheExactIntegrals)
{
  for (const char *trial : {"fourier", "bspline", "daubechies6", "haar"})
    for (const char *weighting : {"fourier", "bspline", "haar", "daubechies10"})
      for (const unsigned int n : {63u, 64u, 48u})
      {
        SCOPED_TRACE(std::string(trial) + ":" + weighting + " " + std::to_string(n));
        const auto a = create_time_basis(trial, n), b = create_time_basis(weighting, n);
        std::optional<TimePairing> pairing;
        for (const TimeForm form : {TimeForm::distributional, TimeForm::weak, TimeForm::strong})
          try
          {
            pairing = pair_time_bases(*a, *b, form);
            break;
          }
          catch (const InputError &)
          {
          }
        if (!pairing)
          continue;
        const TimeSampling sampling(*a, *b, *pairing, 4096);
        const std::vector<double> one(sampling.n_samples(), 1.);
        std::vector<double> moments(n);
        // a rule through functions that are no polynomials, where the shifts do not fall on samples
        const double limit = b->is_dyadic() && n != 64 ? 1e-5 : 1e-9;
        sampling.moments(one.data(), moments.data());
        EXPECT_NEAR(moments[0], pairing->a0[0].real(), limit);
        for (unsigned int k = 1; k < n; ++k)
          EXPECT_NEAR(moments[k], 0, limit) << k;
      }
}

// The axial bar by its poles, most of its modes damped beyond critical: with harmonics the motion of its modes, in the spring
// and at the rigid stop.
TEST(PeriodicBalance, PolesMoveAsTheirModes)
{
  const AxialBarCase c = axial_bar_150();
  for (const bool rigid : {false, true})
  {
    ForcedBody modes = axial_bar(c, rigid);
    ForcedBody poles = modes;
    static_cast<BodyInContact &>(poles) = by_poles(modes);
    const auto law = rigid ? create_normal_law("signorini") : penalty(c);
    const auto solution = [&](const ForcedBody &body)
    {
      PeriodicBalance balance(body, law, pair("fourier", "fourier", 63));
      balance.set_force(c.excitation());
      const PeriodicSolution found = balance.solve();
      EXPECT_TRUE(found.converged);
      return found;
    };
    const PeriodicSolution by_modes = solution(modes), of_poles = solution(poles);
    EXPECT_LT(relative_error(of_poles.force, by_modes.force), 1e-9);
    EXPECT_LT(relative_error(of_poles.displacement, by_modes.displacement), 1e-9);
  }
}

TEST(PeriodicBalance, DerivativesOfABodyByPoles)
{
  ForcedBody body = three_directions(2);
  static_cast<BodyInContact &>(body) = by_poles(body);
  BalanceSettings settings = pair("fourier", "fourier", 9);
  settings.friction = 0.3;
  PeriodicBalance balance(body, create_normal_law("signorini"), settings);
  expect_right_derivatives(balance, {1., 0.4});
}

// Neighbouring nodes of the bar, whose gaps close at nearly the same time: refined from few functions, and followed from a gap
// that the motion does not touch.
TEST(PeriodicBalance, SeveralPointsAreRefinedFromFewFunctions)
{
  const AxialBarCase c = axial_bar_1275();
  for (const unsigned int n_points : {2u, 4u, 8u})
  {
    PeriodicBalance balance(with_points(c, n_points), penalty(c), pair("fourier", "fourier", 63));
    balance.set_force(c.excitation());
    const PeriodicSolution refined = balance.solve(),
                           followed = balance.solve(std::vector<double>(balance.n_unknowns(), 0.));
    ASSERT_TRUE(refined.converged && followed.converged);
    EXPECT_EQ(refined.homotopy_steps, 0u);
    EXPECT_LT(refined.iterations, 60u);
    double difference = 0, size = 0;
    for (unsigned int k = 0; k < refined.force.size(); ++k)
    {
      difference += std::pow(refined.force[k] - followed.force[k], 2);
      size += std::pow(followed.force[k], 2);
    }
    EXPECT_LT(std::sqrt(difference / size), 1e-8) << n_points;
  }
}
