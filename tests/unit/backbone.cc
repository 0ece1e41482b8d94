// Nonsmooth modes of the clamped bar against a rigid stop. Truth: their closed form by d'Alembert's waves.
#include "axial_bar.h"

#include <vibrocontact/analyses/periodic/backbone.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/contact/laws/normal_laws.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace vibrocontact;

namespace
{
  const double modulus = AxialBarCase::modulus, area = AxialBarCase::area, length = AxialBarCase::length;
  const double speed = std::sqrt(modulus / AxialBarCase::density);

  /// Tip over the gap at a phase from the middle of the contact, theta = T c / L between 3 and 4: integral over a window of two
  /// lengths of F' = v on [0, theta - 2), -v on the rest of the period.
  double exact_tip(const double theta, double phase)
  {
    const double positive = theta - 2, v = 1 / (2 * theta - 6);
    phase -= std::floor(phase);
    const double begin = theta * phase + 0.5 * (positive - 2);
    const auto integral = [&](const double x)
    {
      const double periods = std::floor(x / theta), rest = x - periods * theta;
      return v * (periods * (positive - 2) + (rest < positive ? rest : 2 * positive - rest));
    };
    return integral(begin + 2) - integral(begin);
  }

  /// H_m = tan(k L) / (E S k), k = 2 pi m f / c: no elements, no modes
  CondensedBody continuous_bar(const TimePairing &pairing, const HarmonicForce &force)
  {
    CondensedBody result;
    result.n_rows = 1;
    result.n_functions = pairing.n_functions;
    for (unsigned int m = 0; m < pairing.a0.size(); ++m)
    {
      const double by_f = 2 * M_PI * m / speed, k = by_f * force.frequency, tangent = std::tan(k * length);
      const double h = m == 0 ? length / (modulus * area) : tangent / (modulus * area * k);
      const double slope =
          m == 0 ? 0. : by_f * (length * (1 + tangent * tangent) - tangent / k) / (modulus * area * k);
      result.compliance.push_back(h);
      result.compliance_slope.push_back(slope);
      result.linear.push_back(h * force.amplitude * pairing.sine[m]);
      result.linear_slope.push_back(slope * force.amplitude * pairing.sine[m]);
    }
    return result;
  }
} // namespace

TEST(Backbone, NonsmoothModeOfTheClampedBar)
{
  AxialBarCase undamped = axial_bar_1275();
  undamped.beta = 0;
  // tongues of the harmonics that meet a natural frequency in flight (clamped, free) or held at the stop
  std::vector<double> flight, held;
  for (unsigned int n = 0; n < 20; ++n)
  {
    flight.push_back((2 * n + 1) * speed / (4 * length));
    held.push_back((n + 1) * speed / (2 * length));
  }
  const auto near = [](const std::vector<double> &natural, const double f)
  {
    const auto resonances = internal_resonances(natural, 0.98 * speed / 3.8, 1.02 * speed / 3.3, 15);
    EXPECT_GE(resonances.size(), 8u);
    return std::any_of(resonances.begin(), resonances.end(),
                       [f](const InternalResonance &resonance)
                       { return std::abs(f / resonance.frequency - 1) < 4e-3; });
  };
  const auto in_tongue = [&](const double f) { return near(flight, f) || near(held, f); };

  for (const bool continuous : {false, true})
  {
    BalanceSettings settings;
    settings.n_functions = 31; // 15 harmonics
    settings.n_samples = 1024;
    PeriodicBalance balance(axial_bar(undamped, true, 100), create_normal_law("signorini"), settings);
    balance.set_force({0, speed / 3.8});
    if (continuous)
      balance.set_condensation([&](const HarmonicForce &force)
                               { return continuous_bar(balance.integrals(), force); });
    const Backbone backbone = follow_backbone(balance, speed / 3.8, speed / 3.3, 101);
    EXPECT_GE(backbone.points.size(), 90u);
    for (const double f : backbone.missed)
      EXPECT_TRUE(in_tongue(f)) << "T c / L " << speed / f;
    unsigned int accurate = 0;
    for (const BranchPoint &point : backbone.points)
    {
      // no force is needed
      EXPECT_LT(std::abs(point.excitation.amplitude), 1e-6 * point.force[0]);
      balance.set_force(point.excitation);
      std::vector<double> residual;
      balance.evaluate(point.force, residual, nullptr, nullptr);
      const double theta = speed / (length * point.excitation.frequency);
      double error = 0, size = 0;
      for (unsigned int i = 0; i < balance.sampling().n_samples(); ++i)
      {
        const double exact = undamped.gap * exact_tip(theta, balance.sampling().phases()[i]);
        error += std::pow(balance.row_samples(0)[i] - exact, 2);
        size += exact * exact;
      }
      if (std::sqrt(error / size) <= 0.02)
        ++accurate;
      else
        EXPECT_TRUE(in_tongue(point.excitation.frequency))
            << "T c / L " << theta << (continuous ? " continuous: " : ": ") << std::sqrt(error / size);
    }
    EXPECT_GE(accurate, 80u);
  }
}

TEST(Backbone, AsksForFourierFunctions)
{
  BalanceSettings settings;
  settings.trial = settings.weighting = "bspline";
  settings.n_functions = 16;
  PeriodicBalance balance(axial_bar(axial_bar_1275()), create_normal_law("linear spring", {1e9, 1}),
                          settings);
  balance.set_force({0, 1400});
  EXPECT_THROW(follow_backbone(balance, 1400, 1500, 3), InputError);
}
