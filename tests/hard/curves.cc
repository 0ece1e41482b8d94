// Curves and periodic motions at their limits: folds that nearly vanish, loops (tongues) of a millionth, near branch points,
// grazing, two functions, penalties of 1e14, resonance without damping.

#include "../unit/axial_bar.h"
#include "../unit/plane_curve.h"
#include "report.h"

#include <vibrocontact/analyses/periodic/balance.h>
#include <vibrocontact/analyses/periodic/periodic_error.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/contact/laws/normal_laws.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

using namespace vibrocontact;

namespace
{
  std::vector<double> folds_of(const Curve &curve)
  {
    std::vector<double> folds;
    for (const CurvePoint &point : curve.points)
      if (point.kind == CurvePoint::Kind::fold)
        folds.push_back(point.p);
    return folds;
  }

  /// One mode of 1 kg and 1 rad/s under sin(omega t) beside a stop.
  ForcedBody oscillator(const double damping, const double gap, const double compliance = 0)
  {
    ForcedBody body;
    body.omega = {1.};
    body.damping_ratio = {damping};
    body.trace.reinit(1, 1);
    body.trace(0, 0) = 1;
    body.residual.reinit(1, 1);
    body.residual(0, 0) = compliance;
    body.residual_load = {0.};
    body.modal_load = {0.};
    body.gap = {gap};
    return body;
  }

  /// of its point without contact
  double linear_amplitude(const double damping, const double omega, const double compliance)
  {
    return std::abs(compliance + 1. / std::complex<double>(1 - omega * omega, 2 * damping * omega));
  }

  PeriodicBalance balance_of(const ForcedBody &body, const std::shared_ptr<const NormalLaw> &law,
                             const unsigned int n_functions, const double omega,
                             const std::string &basis = "fourier")
  {
    BalanceSettings settings;
    settings.trial = settings.weighting = basis;
    settings.n_functions = n_functions;
    PeriodicBalance balance(body, law, settings);
    balance.set_force({1., omega / (2 * M_PI)});
    return balance;
  }
} // namespace

// p = x^3 - a x near its cusp: two folds at -+2 (a / 3)^1.5, down to 8e-7 and 0.01 apart in p and x, found by steps shorter
// than that; none where a < 0.
TEST(HardCurves, FoldsNearACusp)
{
  for (const double a : {1e-2, 1e-4, -1e-4})
  {
    Plane cubic;
    cubic.value = [a](double x, double p) { return p - x * x * x + a * x; };
    cubic.by_unknown = [a](double x, double) { return a - 3 * x * x; };
    cubic.by_parameter = [](double, double) { return 1.; };
    ContinuationSettings settings;
    settings.p_min = -1;
    settings.p_max = 1;
    settings.location_tolerance = 1e-12;
    settings.max_step = 2e-3;
    const Curve curve = continue_curve(cubic, start_at(-1, -1 + a), settings);
    EXPECT_EQ(curve.end, Curve::End::parameter_limit) << curve.reason();
    const std::vector<double> folds = folds_of(curve);
    EXPECT_EQ(folds.size(), a > 0 ? 2u : 0u) << a;
    if (folds.size() != 2 || a < 0)
      continue;
    const double truth = 2 * std::pow(a / 3, 1.5);
    EXPECT_NEAR(folds[0], truth, 1e-3 * truth) << a;
    EXPECT_NEAR(folds[1], -truth, 1e-3 * truth) << a;
    report("folds", std::max(std::abs(folds[0] / truth - 1), std::abs(folds[1] / truth + 1)));
  }
}

// A loop of its own (a tongue) of radius 1e-3 and 1e-5 beside curves of size one: closed, with its two folds. At 1e-6 rounding of
// the coordinates is more than the tolerance: it says that Newton's method does not converge.
TEST(HardCurves, TongueOfAHundredThousandth)
{
  for (const double radius : {1e-3, 1e-5, 1e-6})
  {
    Plane circle;
    circle.value = [radius](double x, double p)
    { return (std::pow(x - 1, 2) + std::pow(p - 2, 2)) / radius - radius; };
    circle.by_unknown = [radius](double x, double) { return 2 * (x - 1) / radius; };
    circle.by_parameter = [radius](double, double p) { return 2 * (p - 2) / radius; };
    ContinuationSettings settings;
    settings.x_scale = settings.p_scale = settings.residual_scale = radius;
    settings.location_tolerance = 1e-6 * radius;
    const Curve curve = continue_curve(circle, start_at(1 + 0.8 * radius, 2 + 0.6 * radius), settings);
    // closed, or told
    if (radius < 1e-5 && curve.end != Curve::End::closed)
    {
      EXPECT_NE(curve.reason().find("Newton's method did not converge"), std::string::npos) << curve.reason();
      continue;
    }
    EXPECT_EQ(curve.end, Curve::End::closed) << radius << " " << curve.reason();
    const std::vector<double> folds = folds_of(curve);
    ASSERT_EQ(folds.size(), 2u) << radius;
    EXPECT_NEAR((folds[0] - 2) / radius, 1, 1e-5);
    EXPECT_NEAR((folds[1] - 2) / radius, -1, 1e-5);
    report("folds over radius",
           std::max(std::abs((folds[0] - 2) / radius - 1), std::abs((folds[1] - 2) / radius + 1)));
  }
}

// x (x - p) = e: two branches that hardly miss each other at the origin, sqrt(e) apart. The curve turns and keeps to its own.
TEST(HardCurves, BranchesThatHardlyMiss)
{
  for (const double e : {1e-2, 1e-4, 1e-6})
  {
    Plane near_cross;
    near_cross.value = [e](double x, double p) { return x * (x - p) - e; };
    near_cross.by_unknown = [](double x, double p) { return 2 * x - p; };
    near_cross.by_parameter = [](double x, double) { return -x; };
    ContinuationSettings settings;
    settings.p_min = -2;
    settings.p_max = 1;
    // from x = e / (x - p) ~ e on the upper branch, which turns to x = p
    const Curve curve = continue_curve(near_cross, start_at(e, -1), settings);
    EXPECT_EQ(curve.end, Curve::End::parameter_limit) << curve.reason();
    const double x = curve.points.back().x[0];
    const double truth = 0.5 * (1 + std::sqrt(1 + 4 * e));
    EXPECT_NEAR(x, truth, 1e-8) << e;
    report("end of the branch", x - truth);
    EXPECT_EQ(folds_of(curve).size(), 0u) << e;
  }
}

// A stop at the amplitude to 1e-9 of it, just beyond reach and just within: the linear motion, and a force that is as small.
TEST(HardCurves, Grazing)
{
  const double damping = 0.02, omega = 0.9, compliance = 1e-3,
               amplitude = linear_amplitude(damping, omega, compliance);
  double worst = 0;
  for (const std::string law : {"signorini", "linear spring"})
    for (const double gap : {1 + 1e-9, 1., 1 - 1e-9, 1 - 1e-4})
    {
      PeriodicBalance balance = balance_of(oscillator(damping, amplitude * gap, compliance),
                                           law == "signorini" ? create_normal_law("signorini")
                                                              : create_normal_law("linear spring", {1., 1e3}),
                                           31, omega);
      const PeriodicSolution s = balance.solve();
      EXPECT_TRUE(s.converged) << law << " " << gap << " " << s.residual;
      double force = 0;
      for (const double f : s.force)
        force = std::max(force, std::abs(f));
      // the first harmonic stands as half an amplitude
      const double first = 2 * std::hypot(s.displacement[1], s.displacement[2]);
      const double within = std::max(1 - gap, 0.);
      if (gap > 1)
        EXPECT_EQ(force, 0) << law;
      EXPECT_LE(force, 100 * within + 1e-10) << law << " " << gap;
      EXPECT_NEAR(first / amplitude, 1, 3 * within + 1e-12) << law << " " << gap;
      if (gap > 1 - 1e-6)
        worst = std::max(worst, std::abs(first / amplitude - 1));
    }
  report("amplitude", worst);
}

// Stiff springs beside a compliance of 1e-3 m/N: they tend to 1e8 N/m as one over their stiffness, to what the samples resolve.
// One of 1e14 N/m converges to the same motion, or says that it does not converge.
TEST(HardCurves, PenaltyOfOneHundredTrillion)
{
  const double damping = 0.02, omega = 0.9, compliance = 1e-3;
  const ForcedBody body = oscillator(damping, 0.6 * linear_amplitude(damping, omega, compliance), compliance);
  const auto at = [&](const double k) {
    return balance_of(body, create_normal_law("linear spring", {1., k}), 31, omega).solve();
  };
  const PeriodicSolution stiff = at(1e8);
  const auto distance = [&](const PeriodicSolution &s)
  {
    double size = 0, worst = 0;
    for (unsigned int i = 0; i < s.displacement.size(); ++i)
    {
      size = std::max(size, std::abs(stiff.displacement[i]));
      worst = std::max(worst, std::abs(s.displacement[i] - stiff.displacement[i]));
    }
    return worst / size;
  };
  EXPECT_TRUE(stiff.converged);
  double before = 0;
  for (const double k : {1e3, 1e4, 1e5})
  {
    const PeriodicSolution s = at(k);
    EXPECT_TRUE(s.converged) << k;
    if (before > 0)
      EXPECT_LT(distance(s), 0.3 * before) << k;
    before = distance(s);
    report("distance to 1e8", before);
  }
  const PeriodicSolution stiffest = at(1e14);
  EXPECT_TRUE(!stiffest.converged || distance(stiffest) < 1e-3);
  EXPECT_LT(distance(stiffest), 1e-2);
  report(stiffest.converged ? "1e14 converged" : "1e14 did not converge, residual", stiffest.residual);
}

// Less than three functions of time hold no sine: what they balance is no motion, and none is told; three are the first
// harmonic, whose closed form is that of the linear oscillator.
TEST(HardCurves, TwoFunctions)
{
  const double damping = 0.02, omega = 0.9;
  for (const unsigned int n : {2u, 3u})
  {
    const PeriodicSolution s =
        balance_of(oscillator(damping, 1e3), create_normal_law("linear spring", {1., 1.}), n, omega).solve();
    EXPECT_TRUE(s.converged) << n;
    const double first = n < 3 ? 0 : 2 * std::hypot(s.displacement[1], s.displacement[2]);
    if (n == 3)
      EXPECT_NEAR(first / linear_amplitude(damping, omega, 0), 1, 1e-12);
    else
      for (const double value : s.displacement)
        EXPECT_TRUE(std::isfinite(value));
  }
  EXPECT_THROW(
      balance_of(oscillator(damping, 1), create_normal_law("linear spring", {1., 1.}), 2, omega, "haar"),
      InputError);
}

// Without damping at the very frequency of the mode nothing bounds the motion but the stop, whose first harmonic then is what drives
// the mode. Rounding decides (it differs between processors) whether this is found or no convergence is said, with finite
// numbers; at 1e-6 beside it the linear motion is the closed form, 5e5 times the answer at rest.
TEST(HardCurves, ExactResonanceWithoutDamping)
{
  for (const std::string law : {"signorini", "linear spring"})
  {
    constexpr double compliance = 1e-3;
    PeriodicBalance balance = balance_of(oscillator(0, 1, compliance),
                                         law == "signorini" ? create_normal_law("signorini")
                                                            : create_normal_law("linear spring", {1., 10.}),
                                         31, 1.);
    const PeriodicSolution s = balance.solve();
    if (s.converged)
    {
      EXPECT_NEAR(s.force[1], 0, 1e-6) << law;
      EXPECT_NEAR(s.force[2], -0.5, 1e-6) << law;
      // all other harmonics are what the mode and the compliance answer to the stop
      for (unsigned int i = 0; i < s.force.size(); ++i)
        if (const double k = (i + 1) / 2; k != 1)
          EXPECT_NEAR(s.displacement[i], -(1 / (1 - k * k) + compliance) * s.force[i], 1e-9) << law << i;
    }
    for (const double value : s.displacement)
      EXPECT_TRUE(std::isfinite(value)) << law;
  }
  const double omega = 1 + 1e-6;
  const PeriodicSolution s =
      balance_of(oscillator(0, 1e7), create_normal_law("linear spring", {1., 10.}), 31, omega).solve();
  EXPECT_TRUE(s.converged);
  const double error =
      2 * std::hypot(s.displacement[1], s.displacement[2]) / linear_amplitude(0, omega, 0) - 1;
  EXPECT_NEAR(error, 0, 1e-9);
  report("amplitude beside it", error);
}
