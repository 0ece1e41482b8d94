// Response curve of the axial bar near its first resonance, its folds and their stability. Truth: the same branch by
// shooting, the linear motion in closed form, multiplier +1 at folds, Hill's determinant.
#include "axial_bar.h"

#include <vibrocontact/analyses/periodic/floquet.h>
#include <vibrocontact/analyses/periodic/response_curve.h>
#include <vibrocontact/analyses/periodic/shooting.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/contact/laws/normal_laws.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

using namespace vibrocontact;

namespace
{
  const AxialBarCase bar_case = axial_bar_1275();

  std::unique_ptr<PeriodicBalance> balance_of(const unsigned int n_functions,
                                              const unsigned int n_samples = 4096,
                                              const std::string &trial = "fourier",
                                              const std::string &weighting = "fourier")
  {
    BalanceSettings settings;
    settings.trial = trial;
    settings.weighting = weighting;
    settings.n_functions = n_functions;
    settings.n_samples = n_samples;
    auto balance = std::make_unique<PeriodicBalance>(
        axial_bar(bar_case),
        create_normal_law("exponential penalty", {bar_case.amplitude, bar_case.exponent}), settings);
    balance->set_force(bar_case.excitation());
    return balance;
  }

  BranchSettings over_frequency(const StabilityMethod stability = StabilityMethod::none)
  {
    BranchSettings settings;
    settings.start = settings.least = 1180;
    settings.most = 1420;
    settings.stability = stability;
    return settings;
  }

  /// amplitude of the tip without contact [m]
  double linear_amplitude(const ForcedBody &body, const double f)
  {
    const double omega = 2 * M_PI * f;
    std::complex<double> sum = 0;
    for (unsigned int k = 0; k < body.n_modes(); ++k)
      sum += body.trace(0, k) * body.modal_force(k) /
             std::complex<double>(body.omega[k] * body.omega[k] - omega * omega,
                                  2 * body.damping_ratio[k] * body.omega[k] * omega);
    return bar_case.force * std::abs(sum);
  }

  /// Periodic motions by shooting as a curve in frequency; unknowns w q, q'.
  struct ShootingCurve : CurveEquations
  {
    const ForcedBody body = axial_bar(bar_case);
    const std::shared_ptr<const NormalLaw> law =
        create_normal_law("exponential penalty", {bar_case.amplitude, bar_case.exponent});
    static constexpr double phase = 0.75;
    static constexpr unsigned int n_steps = 64;

    double unit(const unsigned int k) const { return k < body.n_modes() ? 1 / body.omega[k] : 1.; }
    ShootingResidual at(const std::vector<double> &x, const double f) const
    {
      std::vector<double> state = x;
      for (unsigned int k = 0; k < x.size(); ++k)
        state[k] *= unit(k);
      return shooting_residual(body, law, {bar_case.force, f}, n_steps, phase, state);
    }
    void evaluate(const std::vector<double> &x, const double f, std::vector<double> &residual,
                  DenseMatrix *by_x, std::vector<double> *by_f) override
    {
      const ShootingResidual r = at(x, f);
      residual = r.value;
      if (by_x)
        *by_x = r.by_state;
      if (by_f)
        *by_f = r.by_frequency;
      for (unsigned int k = 0; k < x.size(); ++k)
      {
        residual[k] /= unit(k);
        if (by_f)
          (*by_f)[k] /= unit(k);
        for (unsigned int j = 0; by_x && j < x.size(); ++j)
          (*by_x)(k, j) *= unit(j) / unit(k);
      }
    }
    /// state of a motion of the balance
    CurvePoint start(const PeriodicBalance &balance, const BranchPoint &point) const
    {
      const double f = point.excitation.frequency;
      const DenseMatrix q =
          modal_coefficients(body, balance.integrals(), point.excitation, balance.body_forces(point.force));
      CurvePoint result;
      result.p = f;
      for (unsigned int d = 0; d < 2; ++d)
      {
        const DenseMatrix values = sampled(balance.trial(), {phase}, d);
        for (unsigned int k = 0; k < body.n_modes(); ++k)
        {
          double sum = 0;
          for (unsigned int i = 0; i < q.m(); ++i)
            sum += values(0, i) * q(i, k);
          result.x.push_back(d == 0 ? sum * body.omega[k] : sum * f);
        }
      }
      return result;
    }
    double multiplier(const CurvePoint &point) const
    {
      DenseMatrix monodromy = at(point.x, point.p).by_state;
      for (unsigned int k = 0; k < point.x.size(); ++k)
        monodromy(k, k) = monodromy(k, k) + 1;
      return floquet_multipliers(monodromy)[0].real();
    }
  };

  /// fold of the branch by shooting next to a motion of the balance
  CurvePoint fold_by_shooting(const PeriodicBalance &balance, const BranchPoint &near, const int direction,
                              const double scale)
  {
    ShootingCurve shooting;
    const CurvePoint start = shooting.start(balance, near);
    ContinuationSettings settings;
    for (const double value : start.x)
      settings.x_scale += value * value;
    settings.x_scale = settings.residual_scale = std::sqrt(settings.x_scale);
    settings.p_scale = scale;
    settings.direction = direction;
    settings.first_step = 5e-3;
    settings.max_step = 0.02;
    settings.max_points = 40;
    settings.tolerance = 1e-9;
    settings.p_min = 1180;
    settings.p_max = 1420;
    for (const CurvePoint &point : continue_curve(shooting, start, settings).points)
      if (point.kind == CurvePoint::Kind::fold)
        return point;
    return {};
  }
} // namespace

TEST(ResponseCurve, FoldsByTwoMethodsAndGrazing)
{
  CurvePoint upper_fold, lower_fold;
  for (const unsigned int n_functions : {63u, 127u})
  {
    const auto balance = balance_of(n_functions);
    const ResponseCurve curve = follow_response(*balance, over_frequency(StabilityMethod::monodromy));
    EXPECT_TRUE(curve.complete) << curve.reason;
    ASSERT_EQ(curve.folds.size(), 2u);
    ASSERT_EQ(curve.grazing.size(), 2u);
    // grazing is where the linear amplitude is the gap
    for (const double f : curve.grazing)
    {
      const double slope = (linear_amplitude(balance->linear_body(), f + 0.01) -
                            linear_amplitude(balance->linear_body(), f - 0.01)) /
                           0.02;
      EXPECT_NEAR((linear_amplitude(balance->linear_body(), f) - bar_case.gap) / slope, 0, 5e-6);
    }
    // between the folds the motion is unstable, elsewhere stable; next to them a sample more or less in contact counts
    bool between = false;
    for (const BranchPoint &point : curve.points)
    {
      if (point.kind == CurvePoint::Kind::fold)
        between = !between;
      else if (std::abs(std::abs(point.multiplier) - 1) > 0.05)
        EXPECT_EQ(point.is_stable(), !between) << point.excitation.frequency;
    }
    // shooting from motions on either side of the unstable part
    const auto after_fold = [&](const unsigned int which)
    {
      unsigned int k = 0, folds = 0;
      while (folds <= which)
        folds += curve.points[k++].kind == CurvePoint::Kind::fold;
      return k;
    };
    if (upper_fold.x.empty())
    {
      upper_fold = fold_by_shooting(*balance, curve.points[after_fold(0) - 8], 1, 25);
      lower_fold = fold_by_shooting(*balance, curve.points[after_fold(1) - 8], -1, 1);
    }
    ASSERT_FALSE(upper_fold.x.empty());
    ASSERT_FALSE(lower_fold.x.empty());
    EXPECT_NEAR(curve.folds[0], upper_fold.p, 0.01);
    EXPECT_NEAR(curve.folds[1], lower_fold.p, 2e-4);
    EXPECT_NEAR(curve.grazing[1] - curve.folds[1], 2e-3, 5e-4);
    EXPECT_NEAR(ShootingCurve().multiplier(upper_fold), 1, 1e-3);
    EXPECT_NEAR(ShootingCurve().multiplier(lower_fold), 1, 1e-3);
    for (const BranchPoint &point : curve.points)
      if (point.kind == CurvePoint::Kind::fold)
      {
        balance->set(SceneParameter::frequency, point.excitation.frequency);
        std::vector<double> residual;
        balance->evaluate(point.force, residual, nullptr, nullptr);
        for (const unsigned int n_harmonics : {10u, n_functions / 2})
          EXPECT_NEAR(std::abs(largest_multiplier(*balance, StabilityMethod::hill, 20, n_harmonics) - 1.), 0,
                      2e-2);
      }
  }
}

TEST(ResponseCurve, NarrowResonancesAreMetWhereNothingTouches)
{
  ForcedBody body = axial_bar(bar_case);
  body.gap = {10.};
  body.damping_ratio.assign(body.n_modes(), 1e-4);
  BalanceSettings balance_settings;
  balance_settings.n_functions = 9;
  PeriodicBalance balance(body,
                          create_normal_law("exponential penalty", {bar_case.amplitude, bar_case.exponent}),
                          balance_settings);
  balance.set_force(bar_case.excitation());
  for (const int direction : {1, -1})
  {
    BranchSettings settings;
    settings.least = 10;
    settings.most = 10000;
    settings.start = direction > 0 ? settings.least : settings.most;
    settings.direction = direction;
    settings.stability = StabilityMethod::none;
    const ResponseCurve curve = follow_response(balance, settings);
    EXPECT_TRUE(curve.complete) << curve.reason;
    EXPECT_LT(curve.points.size(), 400u);
    unsigned int n_resonances = 0;
    for (const double omega : body.omega)
    {
      const double f = omega / (2 * M_PI);
      if (f > settings.most)
        continue;
      ++n_resonances;
      double largest = 0;
      for (const BranchPoint &point : curve.points)
        if (std::abs(point.excitation.frequency / f - 1) < 0.01)
          largest = std::max(largest, point.amplitude);
      EXPECT_NEAR(largest / linear_amplitude(body, f), 1, 1e-3) << f;
    }
    EXPECT_EQ(n_resonances, 4u);
  }
}

TEST(ResponseCurve, BothDirectionsAreOneCurve)
{
  const auto balance = balance_of(63);
  const ResponseCurve up = follow_response(*balance, over_frequency());
  BranchSettings settings = over_frequency();
  settings.start = settings.most;
  settings.direction = -1;
  const ResponseCurve down = follow_response(*balance, settings);
  ASSERT_EQ(up.folds.size(), 2u);
  ASSERT_EQ(down.folds.size(), 2u);
  // at the folds samples come into contact one by one: the curve is that rough
  EXPECT_NEAR(up.folds[0], down.folds[1], 2e-3);
  EXPECT_NEAR(up.folds[1], down.folds[0], 2e-4);
}

TEST(ResponseCurve, ForceAndGapMeetTheFrequencysBranch)
{
  // the motion at 1300 Hz on three ways
  const auto balance = balance_of(63);
  const PeriodicSolution direct = [&]
  {
    BranchSettings settings = over_frequency();
    settings.most = 1300;
    const ResponseCurve curve = follow_response(*balance, settings);
    return balance->solve(curve.points.back().force);
  }();
  ASSERT_TRUE(direct.converged);
  for (const SceneParameter parameter : {SceneParameter::force, SceneParameter::gap})
  {
    balance->set_force({bar_case.force, 1300});
    BranchSettings settings;
    settings.parameter = parameter;
    settings.stability = StabilityMethod::none;
    if (parameter == SceneParameter::force)
    {
      settings.least = settings.start = 0;
      settings.most = bar_case.force;
    }
    else
    {
      // from where the linear motion does not touch
      settings.most = settings.start = 1.2 * linear_amplitude(balance->linear_body(), 1300);
      settings.least = bar_case.gap;
      settings.direction = -1;
    }
    const ResponseCurve curve = follow_response(*balance, settings);
    ASSERT_TRUE(curve.complete) << curve.reason;
    EXPECT_EQ(curve.grazing.size() % 2, 1u);
    // the branch ends where the parameter has its value; derivatives are those of differences
    const BranchPoint &end = curve.points.back();
    balance->set(SceneParameter::gap, bar_case.gap);
    balance->set(SceneParameter::force, bar_case.force);
    std::vector<double> residual;
    balance->evaluate(end.force, residual, nullptr, nullptr);
    double size = 0;
    for (const double value : residual)
      size += value * value;
    EXPECT_LT(std::sqrt(size) / balance->force_scale(end.force), 1e-9);
  }
}

TEST(ResponseCurve, DerivativesByParametersAgainstDifferences)
{
  const auto balance = balance_of(31, 1024);
  const PeriodicSolution solution = balance->solve();
  ASSERT_TRUE(solution.converged);
  for (const auto &[parameter, value] :
       {std::pair(SceneParameter::frequency, bar_case.frequency),
        std::pair(SceneParameter::force, bar_case.force), std::pair(SceneParameter::gap, bar_case.gap)})
  {
    std::vector<double> residual, derivative, plus, minus;
    balance->set(parameter, value);
    balance->evaluate(solution.force, residual, nullptr, &derivative, parameter);
    const double h = 1e-7 * value;
    balance->set(parameter, value + h);
    balance->evaluate(solution.force, plus, nullptr, nullptr);
    balance->set(parameter, value - h);
    balance->evaluate(solution.force, minus, nullptr, nullptr);
    balance->set(parameter, value);
    double error = 0, size = 0;
    for (unsigned int k = 0; k < derivative.size(); ++k)
    {
      error += std::pow(derivative[k] - (plus[k] - minus[k]) / (2 * h), 2);
      size += derivative[k] * derivative[k];
    }
    EXPECT_LT(std::sqrt(error / size), 1e-5);
  }
}

TEST(ResponseCurve, MultipliersOfPermanentContactAndOfNone)
{
  // one oscillator, stiffness k + K throughout, with and without residual
  ForcedBody body;
  const double m = 2, k = 800, d = 3, K = 5000;
  body.omega = {std::sqrt(k / m)};
  body.damping_ratio = {d / (2 * std::sqrt(k * m))};
  body.trace.reinit(1, 1);
  body.trace(0, 0) = 1 / std::sqrt(m);
  body.modal_load = {0};
  body.residual.reinit(1, 1);
  body.residual_load = {0};
  body.gap = {0};
  for (const double S : {0., 1e-4})
    for (const double stiffness : {0., K})
    {
      body.residual(0, 0) = S;
      const double f = 3.7, series = stiffness / (1 + stiffness * S), omega2 = (k + series) / m,
                   decay = d / (2 * m);
      const std::complex<double> exact =
          std::exp(std::complex<double>(-decay, std::sqrt(omega2 - decay * decay)) / f);
      TangentContact contact{f, {std::vector<double>(4096, stiffness)}};
      const std::vector<std::complex<double>> found = monodromy_multipliers(body, contact);
      ASSERT_EQ(found.size(), 2u);
      for (const auto &value : found)
      {
        EXPECT_NEAR(value.real(), exact.real(), 1e-4);
        EXPECT_NEAR(std::abs(value.imag()), std::abs(exact.imag()), 1e-4);
      }
      EXPECT_NEAR(std::abs(hill_multiplier(body, contact, 5, found[0]) - found[0]), 0, 2e-4);
    }
}

TEST(ResponseCurve, MultipliersAgainstShooting)
{
  // the same contacts, massless node with relaxation: the rigid stop's force jumps at touch
  const ForcedBody body = axial_bar(bar_case, true);
  for (const bool rigid : {true, false})
  {
    const auto law = rigid
                         ? create_normal_law("signorini")
                         : create_normal_law("exponential penalty", {bar_case.amplitude, bar_case.exponent});
    const ShootingSolution solution = shoot(body, law, bar_case.excitation());
    const std::complex<double> exact = floquet_multipliers(solution.monodromy)[0];
    const unsigned int count = 32768;
    const double stiffness = rigid ? 1e4 / body.residual(0, 0) : bar_case.stiffness();
    std::vector<double> k(count, 0.);
    for (const ContactInterval &contact : solution.contacts)
      for (unsigned int i = 0; i < 2 * count; ++i)
        if ((i + 0.5) / count >= contact.begin && (i + 0.5) / count < contact.end)
          k[i % count] = stiffness;
    const std::complex<double> found = monodromy_multipliers(
        slow_part(body, 2 * M_PI * bar_case.frequency * 20), {bar_case.frequency, {k}})[0];
    EXPECT_NEAR(found.real(), exact.real(), 2e-3);
    EXPECT_NEAR(std::abs(found.imag()), std::abs(exact.imag()), 2e-3);
  }
}

TEST(ResponseCurve, HardCases)
{
  // every one converges or says why, and no number is a NaN
  const auto judge = [](const std::string &what, const PeriodicSolution &solution)
  {
    for (const double value : solution.force)
      EXPECT_TRUE(std::isfinite(value)) << what;
    for (const double value : solution.displacement)
      EXPECT_TRUE(std::isfinite(value)) << what;
    EXPECT_TRUE(solution.converged || solution.residual > 0) << what;
  };
  judge("Haar by splines, two functions", balance_of(2, 64, "haar", "bspline")->solve());
  judge("Haar by Fourier, two functions", balance_of(2, 64, "haar", "fourier")->solve());
  judge("even number at a resonance", balance_of(64)->solve());
  {
    const auto grazing = balance_of(63);
    grazing->set_force({bar_case.force, 1226.70279350});
    const PeriodicSolution solution = grazing->solve();
    judge("grazing", solution);
    EXPECT_TRUE(solution.converged);
  }
  {
    const auto still = balance_of(63);
    still->set_force({0, 1275});
    const PeriodicSolution solution = still->solve();
    EXPECT_TRUE(solution.converged);
    for (const double value : solution.displacement)
      EXPECT_EQ(value, 0.);
  }
  for (const double amplitude : {1e9, 1e12})
  {
    BalanceSettings settings;
    settings.n_functions = 63;
    PeriodicBalance stiff(axial_bar(bar_case, true),
                          create_normal_law("exponential penalty", {amplitude, bar_case.exponent}), settings);
    stiff.set_force(bar_case.excitation());
    judge("stiff penalty", stiff.solve());
  }
  {
    AxialBarCase undamped = bar_case;
    undamped.beta = 0;
    BalanceSettings settings;
    settings.n_functions = 63;
    PeriodicBalance balance(axial_bar(undamped),
                            create_normal_law("exponential penalty", {bar_case.amplitude, bar_case.exponent}),
                            settings);
    balance.set_force(bar_case.excitation());
    judge("no damping", balance.solve());
  }
}

TEST(ResponseCurve, GapThroughZeroIntoPreload)
{
  const auto balance = balance_of(63);
  balance->set_force({bar_case.force, 1000});
  BranchSettings settings;
  settings.parameter = SceneParameter::gap;
  settings.start = settings.most = 5e-3;
  settings.least = -5e-3;
  settings.direction = -1;
  settings.stability = StabilityMethod::monodromy;
  const ResponseCurve curve = follow_response(*balance, settings);
  EXPECT_TRUE(curve.complete) << curve.reason;
  const BranchPoint &end = curve.points.back();
  EXPECT_EQ(end.active, 1.);
  // preloaded throughout: mean force and stiffness in closed form, the law being nearly linear
  const double k = bar_case.stiffness(),
               bar = AxialBarCase::modulus * AxialBarCase::area / AxialBarCase::length;
  const double mean = 5e-3 * k * bar / (k + bar);
  EXPECT_NEAR(end.force[0] / mean, 1, 2e-3);
  for (const BranchPoint &point : curve.points)
    EXPECT_TRUE(std::isfinite(point.amplitude) && std::isfinite(std::abs(point.multiplier)));
}

// Turns one after the other without amplitude or contact changing are one fold, or none.
TEST(ResponseCurve, TurnsOfRoundingAreNoFolds)
{
  struct Turn
  {
    double frequency, amplitude, part;
  };
  const auto with_folds = [](const std::vector<Turn> &turns, const unsigned int n_spurious)
  {
    ResponseCurve curve;
    curve.parameter = SceneParameter::frequency;
    curve.complete = true;
    for (const auto &[frequency, amplitude, part] : turns)
    {
      BranchPoint point;
      point.kind = CurvePoint::Kind::fold;
      point.excitation.frequency = frequency;
      point.amplitude = amplitude;
      point.active = part;
      curve.points.push_back(point);
    }
    merge_folds(curve);
    EXPECT_EQ(curve.n_spurious, n_spurious);
    unsigned int marked = 0;
    for (const BranchPoint &point : curve.points)
      marked += point.is_spurious;
    EXPECT_EQ(marked, n_spurious);
    return curve;
  };
  // an upper and a lower fold; the upper one three times; a pair on the way down
  EXPECT_EQ(with_folds({{110, 2, 0.3}, {100, 1, 0.1}}, 0).folds, (std::vector<double>{110, 100}));
  const ResponseCurve three =
      with_folds({{110, 2, 0.3}, {109.9, 1.9995, 0.3}, {110.1, 1.999, 0.2995}, {100, 1, 0.1}}, 2);
  EXPECT_EQ(three.folds, (std::vector<double>{110.1, 100}));
  EXPECT_TRUE(three.complete);
  EXPECT_EQ(with_folds({{110, 2, 0.3}, {105, 1.5, 0.2}, {105.1, 1.4999, 0.2}, {100, 1, 0.1}}, 2).folds,
            (std::vector<double>{110, 100}));
  // a lower fold three times; the same amplitudes with other contacts, and the reverse, are folds
  EXPECT_EQ(with_folds({{110, 2, 0.3}, {100, 1, 0.1}, {100.1, 1, 0.1}, {99.9, 1, 0.1}}, 2).folds,
            (std::vector<double>{110, 99.9}));
  EXPECT_EQ(with_folds({{110, 2, 0.3}, {109, 2, 0.31}}, 0).folds.size(), 2u);
  EXPECT_EQ(with_folds({{110, 2, 0.3}, {109, 1.99, 0.3}}, 0).folds.size(), 2u);
  std::vector<Turn> many;
  for (unsigned int k = 0; k < 55; ++k)
    many.push_back({110 - 0.01 * k + 0.005 * (k % 2), 2 - 1e-4 * k, 0.3});
  const ResponseCurve rough = with_folds(many, 54);
  EXPECT_FALSE(rough.complete);
  EXPECT_NE(rough.reason.find("54 times in a row"), std::string::npos) << rough.reason;
}

TEST(ResponseCurve, RefusesStabilityItCannotTell)
{
  BalanceSettings settings;
  settings.n_functions = 15;
  PeriodicBalance balance(axial_bar(bar_case), create_normal_law("signorini"), settings);
  balance.set_force(bar_case.excitation());
  EXPECT_THROW(follow_response(balance, over_frequency(StabilityMethod::monodromy)), InputError);
}

// A rigid stop: where the branch turns a multiplier of its own tangents is one; elsewhere it is near that by shooting.
TEST(ResponseCurve, MultipliersAtARigidStop)
{
  BalanceSettings settings;
  settings.n_functions = 63;
  settings.n_samples = 16384;
  const ForcedBody body = axial_bar(bar_case, true);
  const auto law = create_normal_law("signorini");
  PeriodicBalance balance(body, law, settings);
  balance.set_force(bar_case.excitation());
  const ResponseCurve curve = follow_response(balance, over_frequency(StabilityMethod::monodromy));
  EXPECT_TRUE(curve.complete) << curve.reason;
  EXPECT_EQ(curve.folds.size(), 2u);
  bool before_fold = true;
  unsigned int compared = 0;
  for (std::size_t k = 0; k < curve.points.size(); ++k)
  {
    const BranchPoint &point = curve.points[k];
    const double f = point.excitation.frequency;
    if (point.kind == CurvePoint::Kind::fold)
    {
      before_fold = false;
      std::printf("fold at %.6f Hz: multiplier %.6f\n", f, point.multiplier.real());
      EXPECT_NEAR(std::abs(point.multiplier - 1.), 0, 1e-3) << f;
    }
    // where there is one motion
    if (before_fold && f < 1310 && k % 12 == 0)
    {
      const std::complex<double> exact =
          floquet_multipliers(shoot(body, law, {bar_case.force, f}).monodromy)[0];
      std::printf("%.3f Hz: %.6f%+.6fj, by shooting %.6f%+.6fj\n", f, point.multiplier.real(),
                  std::abs(point.multiplier.imag()), exact.real(), std::abs(exact.imag()));
      EXPECT_NEAR(point.multiplier.real(), exact.real(), 3e-2) << f;
      EXPECT_NEAR(std::abs(point.multiplier.imag()), std::abs(exact.imag()), 3e-2) << f;
      ++compared;
    }
  }
  EXPECT_GE(compared, 3u);
}
