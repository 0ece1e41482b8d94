// Stability of periodic motions: along whole curves it changes where they turn; multipliers by shooting; with friction the decay
// of a small disturbance in time.

#include "axial_bar.h"
#include "time_stepping.h"

#include <vibrocontact/analyses/periodic/response_curve.h>
#include <vibrocontact/analyses/periodic/shooting.h>
#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/contact/laws/normal_laws.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

using namespace vibrocontact;

namespace
{
  /// The blade of blade_rub.prm in five modes: out of the casing, across, along at the corner, and along the force.
  ForcedBody rubbing_blade(const bool friction)
  {
    ForcedBody body;
    body.omega = {788.115, 3986.992, 4857.133, 10655.508, 13499.88};
    body.damping_ratio.assign(5, 2e-3);
    body.modal_load.assign(5, 0.);
    const double trace[4][5] = {{0.46433, 0.481816, -0.218458, -1.205053, -0.108677},
                                {0.464603, 2.616833, -2.771566, 0.760433, -2.50119},
                                {-3.024387, -1.925675, 2.866858, 2.583265, 1.266606},
                                {-2.619968, -3.2166, -0.00071, 1.731531, 2.879574}},
                 residual[4][4] = {{5.55288e-08, 3.05017e-08, -4.8456e-08, -2.68344e-09},
                                   {3.05017e-08, 1.76595e-07, -1.29697e-07, 1.70045e-08},
                                   {-4.8456e-08, -1.29697e-07, 1.55367e-07, -8.24398e-09},
                                   {-2.68344e-09, 1.70045e-08, -8.24398e-09, 7.13249e-08}};
    body.rows_per_point = friction ? 3 : 1;
    const std::vector<unsigned int> rows =
        friction ? std::vector<unsigned int>{0, 1, 2, 3} : std::vector<unsigned int>{0, 3};
    body.trace.reinit(rows.size(), 5);
    body.residual.reinit(rows.size(), rows.size());
    for (unsigned int i = 0; i < rows.size(); ++i)
    {
      for (unsigned int k = 0; k < 5; ++k)
        body.trace(i, k) = trace[rows[i]][k];
      for (unsigned int j = 0; j < rows.size(); ++j)
        body.residual(i, j) = residual[rows[i]][rows[j]];
    }
    body.force_row = rows.size() - 1;
    body.residual_load.assign(rows.size(), 0.);
    body.gap = {4.8965e-3};
    return body;
  }

  constexpr double exciting_amplitude = 20;

  BranchSettings around_first_mode(const ForcedBody &body)
  {
    BranchSettings settings;
    const double f = body.omega[0] / (2 * M_PI);
    settings.start = settings.least = 0.95 * f;
    settings.most = 1.05 * f;
    return settings;
  }

  /// Folds and branch points divide the branch: where their number so far is even it is stable, elsewhere not.
  void expect_changes_at_folds(const ResponseCurve &curve, const unsigned int n_folds)
  {
    EXPECT_TRUE(curve.complete) << curve.reason;
    EXPECT_EQ(curve.folds.size(), n_folds);
    bool is_stable = true;
    unsigned int n_unstable = 0;
    for (const BranchPoint &point : curve.points)
    {
      if (point.kind == CurvePoint::Kind::fold || point.kind == CurvePoint::Kind::branch_point)
      {
        EXPECT_NEAR(std::abs(point.multiplier), 1, 2e-2) << point.excitation.frequency;
        is_stable = !is_stable;
        continue;
      }
      // what leaves the unit circle elsewhere is no real multiplier above one
      const bool bifurcates = point.multiplier.imag() != 0 || point.multiplier.real() < 0;
      EXPECT_TRUE(point.is_stable() == is_stable || (is_stable && bifurcates))
          << point.excitation.frequency << ": " << point.multiplier;
      n_unstable += !point.is_stable();
    }
    EXPECT_GT(n_unstable, n_folds > 0 ? 10u : 0u);
    EXPECT_TRUE(is_stable);
  }

  double largest_modulus(const DenseMatrix &monodromy)
  {
    return std::abs(floquet_multipliers(monodromy)[0]);
  }
} // namespace

TEST(PeriodicStability, ChangesWhereTheBarsCurveTurns)
{
  const AxialBarCase c = axial_bar_1275();
  for (const auto &[rigid, basis] :
       {std::pair(false, "fourier"), std::pair(false, "bspline"), std::pair(true, "fourier")})
  {
    SCOPED_TRACE(std::string(basis) + (rigid ? ", rigid" : ""));
    BalanceSettings settings;
    settings.trial = settings.weighting = basis;
    settings.n_functions = 63;
    PeriodicBalance balance(axial_bar(c, rigid),
                            rigid ? create_normal_law("signorini")
                                  : create_normal_law("exponential penalty", {c.amplitude, c.exponent}),
                            settings);
    balance.set_force(c.excitation());
    BranchSettings over;
    over.start = over.least = 1180;
    over.most = 1420;
    expect_changes_at_folds(follow_response(balance, over), 2);
  }
}

TEST(PeriodicStability, ChangesWhereAnOscillatorsCurveTurns)
{
  ForcedBody body;
  const double mass = 2, stiffness = 8e5;
  body.omega = {std::sqrt(stiffness / mass)};
  body.damping_ratio = {0.02};
  body.modal_load = {0.};
  body.trace.reinit(1, 1);
  body.trace(0, 0) = 1 / std::sqrt(mass);
  body.residual.reinit(1, 1);
  body.residual_load = {0.};
  body.gap = {4e-3};
  BalanceSettings settings;
  settings.n_functions = 63;
  PeriodicBalance balance(body, create_normal_law("linear spring", {4e4, 100}), settings);
  const double f = body.omega[0] / (2 * M_PI);
  balance.set_force({300, 0.8 * f});
  BranchSettings over;
  over.start = over.least = 0.8 * f;
  over.most = 1.6 * f;
  expect_changes_at_folds(follow_response(balance, over), 2);
}

// Stops that do not relax: stability by the folds and, on the stable and on the unstable branch, by shooting.
TEST(PeriodicStability, RigidStopWithoutFrictionAsByShooting)
{
  const ForcedBody body = rubbing_blade(false);
  const auto law = create_normal_law("signorini");
  BalanceSettings settings;
  settings.n_functions = 101;
  PeriodicBalance balance(body, law, settings);
  balance.set_force({exciting_amplitude, body.omega[0] / (2 * M_PI)});
  const ResponseCurve curve = follow_response(balance, around_first_mode(body));
  expect_changes_at_folds(curve, 2);
  unsigned int compared = 0, unstable = 0;
  for (std::size_t k = 0; k < curve.points.size(); k += 5)
  {
    const BranchPoint &point = curve.points[k];
    if (point.active < 0.02)
      continue;
    balance.set(SceneParameter::frequency, point.excitation.frequency);
    std::vector<double> residual;
    balance.evaluate(point.force, residual, nullptr, nullptr);
    const double *const u = balance.row_samples(0);
    ShootingStart start;
    start.phase = double(std::min_element(u, u + settings.n_samples) - u) / settings.n_samples;
    const DenseMatrix q =
        modal_coefficients(body, balance.integrals(), point.excitation, balance.body_forces(point.force));
    for (unsigned int d = 0; d < 2; ++d)
    {
      const DenseMatrix values = sampled(balance.trial(), {start.phase}, d);
      for (unsigned int m = 0; m < body.n_modes(); ++m)
      {
        double sum = 0;
        for (unsigned int i = 0; i < q.m(); ++i)
          sum += values(0, i) * q(i, m);
        start.state.push_back(d == 0 ? sum : sum * point.excitation.frequency);
      }
    }
    ShootingSettings shooting;
    shooting.phase = start.phase;
    shooting.n_settling = 0;
    shooting.refinement = 1e-6;
    std::optional<double> exact;
    try
    {
      const ShootingSolution found = shoot(body, law, point.excitation, shooting, start);
      double amplitude = 0;
      for (unsigned int i = 0; i < 512; ++i)
        amplitude = std::max(amplitude, std::abs(found.at(i / 512.).displacement));
      // the same motion, not one of another branch
      if (std::abs(amplitude / point.amplitude - 1) < 2e-3)
        exact = largest_modulus(found.monodromy);
    }
    catch (const ConvergenceError &)
    {
      // next to folds
    }
    if (!exact || std::abs(*exact - 1) < 2e-3)
      continue;
    std::printf("%.4f Hz: %.5f%+.5fj |%.5f|, by shooting |%.5f|\n", point.excitation.frequency,
                point.multiplier.real(), point.multiplier.imag(), std::abs(point.multiplier), *exact);
    EXPECT_EQ(point.is_stable(), *exact < 1);
    EXPECT_NEAR(std::abs(point.multiplier), *exact, std::abs(*exact - 1) < 0.03 ? 3e-3 : 1e-4);
    ++compared;
    unstable += *exact > 1;
  }
  EXPECT_GE(compared, 10u);
  EXPECT_GE(unstable, 4u);
}

// With friction: small disturbances of the motion that small steps in time repeat, one period on, against the multipliers, which do
// not depend on the number of functions.
TEST(PeriodicStability, DisturbancesDecayWithFrictionAsInTime)
{
  const ForcedBody body = rubbing_blade(true);
  HarmonicForce force{exciting_amplitude, 125.1};
  constexpr double friction = 0.3;
  const auto balance_of = [&](const unsigned int n_functions)
  {
    BalanceSettings settings;
    settings.n_functions = n_functions;
    settings.friction = friction;
    auto balance = std::make_unique<PeriodicBalance>(body, create_normal_law("signorini"), settings);
    balance->set_force(force);
    return balance;
  };
  double least = 1e300, most = 0;
  for (const unsigned int n_functions : {61u, 101u, 201u})
  {
    const auto balance = balance_of(n_functions);
    ASSERT_TRUE(balance->solve().converged);
    const double decay =
        -std::log(std::abs(largest_multiplier(*balance, StabilityMethod::monodromy, 20, 31)));
    std::printf("%u functions: a disturbance decays by %.6f in a period\n", n_functions, decay);
    least = std::min(least, decay);
    most = std::max(most, decay);
  }
  EXPECT_LT(most / least - 1, 2e-3);

  {
    // periods that begin far from the stop
    const auto balance = balance_of(101);
    ASSERT_TRUE(balance->solve().converged);
    const double *const u = balance->row_samples(0);
    const unsigned int count = balance->sampling().n_samples();
    force.phase = 2 * M_PI * double(std::min_element(u, u + count) - u) / count;
  }
  const auto balance = balance_of(201);
  const PeriodicSolution solution = balance->solve();
  ASSERT_TRUE(solution.converged);
  TimeStepping stepping(body, friction, force, 32768);
  stepping.start(*balance, solution);
  std::vector<double> x = stepping.state();
  const unsigned int n = x.size();
  const auto after_a_period = [&](const std::vector<double> &from)
  {
    stepping.set_state(from);
    stepping.advance();
    return stepping.state();
  };
  const double h = 1e-6 * euclidean_norm(x);
  const auto disturbed = [&]
  {
    DenseMatrix rates(n, n);
    for (unsigned int j = 0; j < n; ++j)
    {
      std::vector<double> more = x, less = x;
      more[j] += h;
      less[j] -= h;
      more = after_a_period(more);
      less = after_a_period(less);
      for (unsigned int i = 0; i < n; ++i)
        rates(i, j) = (more[i] - less[i]) / (2 * h);
    }
    return rates;
  };
  DenseMatrix factors = disturbed();
  factors *= -1;
  for (unsigned int i = 0; i < n; ++i)
    factors(i, i) += 1;
  factors.compute_lu_factorization();
  double change = 1;
  for (unsigned int iteration = 0; iteration < 12 && change > 1e-10; ++iteration)
  {
    const std::vector<double> y = after_a_period(x);
    DenseVector step(n);
    for (unsigned int i = 0; i < n; ++i)
      step[i] = y[i] - x[i];
    factors.solve(step);
    for (unsigned int i = 0; i < n; ++i)
      x[i] += step[i];
    change = step.l2_norm() / euclidean_norm(x);
  }
  EXPECT_LT(change, 1e-8);
  const double in_time = -std::log(largest_modulus(disturbed()));
  std::printf("in time: %.6f\n", in_time);
  EXPECT_NEAR(0.5 * (least + most) / in_time, 1, 1e-2);
}
