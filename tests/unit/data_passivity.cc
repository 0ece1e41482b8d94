// Data that create energy: delays, other quantities and signs are told from good, noisy and rolling data; models become
// passive with the least change.
#include "noisy_data.h"
#include "ring_data.h"

#include <vibrocontact/analyses/identification/identification.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/bodies/passive_fit.h>
#include <vibrocontact/bodies/ring_poles.h>
#include <vibrocontact/numerics/eigenvalues.h>
#include <vibrocontact/numerics/nonnegative.h>
#include <vibrocontact/numerics/vector_fitting.h>
#include <vibrocontact/receptances/data_passivity.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

using namespace vibrocontact;
using Complex = std::complex<double>;

namespace
{
  /// of points in a row, upper half
  FrequencyData data_of(const unsigned int n_points, const double last, const double step,
                        const std::function<Complex(unsigned int, unsigned int, double)> &receptance,
                        const bool both_ways = false)
  {
    FrequencyData data;
    for (unsigned int i = 0; i < n_points; ++i)
      data.labels.push_back(std::string(1, char('A' + i)) + "_z");
    for (double f = step; f < last + step / 2; f += step)
      data.frequency.push_back(f);
    for (unsigned int i = 0; i < n_points; ++i)
      for (unsigned int j = both_ways ? 0 : i; j < n_points; ++j)
      {
        FrequencyData::Entry entry;
        entry.response = i;
        entry.reference = j;
        for (const double f : data.frequency)
          entry.values.push_back(receptance(i, j, 2 * M_PI * f));
        data.entries.push_back(entry);
      }
    return data;
  }

  const FrequencyData &ring_at_rest()
  {
    static const FrequencyData data =
        data_of(3, 1000, 1,
                [](const unsigned int i, const unsigned int j, const double omega)
                { return ring_data::receptance(omega, (double(j) - i) * M_PI / 100, 150); });
    return data;
  }

  FrequencyData changed(FrequencyData data, const std::function<Complex(Complex, double)> &change)
  {
    for (FrequencyData::Entry &entry : data.entries)
      for (std::size_t l = 0; l < entry.values.size(); ++l)
        entry.values[l] = change(entry.values[l], 2 * M_PI * data.frequency[l]);
    return data;
  }

  FrequencyData delayed(const FrequencyData &data, const double delay)
  {
    return changed(data, [=](const Complex value, const double omega)
                   { return value * std::polar(1., -omega * delay); });
  }

  /// A chain of masses between walls, 1 kg each; its dynamic stiffness inverted.
  FrequencyData chain(const double loss_factor, const double damper, const double damping_ratio)
  {
    constexpr unsigned int n = 6;
    return data_of(2, 300, 0.5,
                   [&](const unsigned int i, const unsigned int j, const double omega)
                   {
                     const double k = 4e5;
                     ComplexMatrix Z(n, n);
                     for (unsigned int a = 0; a < n; ++a)
                     {
                       const Complex stiffness =
                           Complex(k, k * loss_factor + 2 * damping_ratio * omega * std::sqrt(k));
                       Z(a, a) = 2. * stiffness - omega * omega * (1 + 0.1 * a);
                       if (a > 0)
                         Z(a, a - 1) = Z(a - 1, a) = -stiffness;
                     }
                     Z(2, 2) += Complex(0, omega * damper);
                     Z.invert();
                     return Complex(Z(i, j));
                   });
  }

  void expect_words(const std::string &text, const std::vector<std::string> &words)
  {
    for (const std::string &word : words)
      EXPECT_NE(text.find(word), std::string::npos) << "'" << text << "' lacks " << word;
  }
} // namespace

TEST(DataPassivity, GoodDataAreNotRefused)
{
  const DataJudgement ring = judge_data(ring_at_rest(), false, 0);
  EXPECT_EQ(ring.complaint, "");
  EXPECT_EQ(ring.gaining, 0);
  ASSERT_TRUE(ring.delay.has_value());
  EXPECT_LT(std::abs(ring.delay->delay), 1e-6);
  EXPECT_EQ(judge_data(noisy(ring_at_rest(), 0.01, 7), false, 0).complaint, "");
  EXPECT_EQ(judge_data(noisy(ring_at_rest(), 0.1, 7), false, 0).complaint, "");
  // hysteretic, a single damper, hardly any damping, none; with noise
  for (const FrequencyData &data : {chain(0.02, 0, 0), chain(0.2, 0, 0), chain(1e-3, 200, 0),
                                    chain(1e-3, 5e3, 0), chain(0, 0, 1e-3), chain(0, 0, 0)})
  {
    EXPECT_EQ(judge_data(data, false, 0).complaint, "");
    EXPECT_EQ(judge_data(noisy(data, 1e-2, 7), false, 0).complaint, "");
  }
}

TEST(DataPassivity, DelaysAreTold)
{
  for (const double delay : {-2e-5, 2e-5, 8e-5, 5e-4})
  {
    const DataJudgement judgement = judge_data(delayed(ring_at_rest(), delay), false, 0);
    char proposal[80];
    std::snprintf(proposal, sizeof proposal, "Identification/Delay = %.1g", delay);
    expect_words(judgement.complaint, {"Passive data"});
    ASSERT_TRUE(judgement.delay.has_value());
    std::printf("delay %g s: estimate %g s, share of lines %g\n", delay, judgement.delay->delay,
                judgement.gaining);
    EXPECT_NEAR(judgement.delay->delay, delay, 2e-6);
  }
  // what was removed is part of the proposal
  expect_words(judge_data(delayed(ring_at_rest(), 5e-4), false, 1e-3).complaint, {"Delay = 0.0015"});
  // lightly damped: one microsecond over 300 Hz is hidden by nothing but the tolerated phase, 100 us by nothing
  expect_words(judge_data(delayed(chain(0, 0, 1e-3), 1e-4), false, 0).complaint, {"Delay = 0.0001"});
  expect_words(judge_data(noisy(delayed(chain(0, 0, 1e-3), 1e-4), 1e-3, 7), false, 0).complaint,
               {"Delay = "});
}

TEST(DataPassivity, OtherQuantitiesAndSignsAreNamed)
{
  const auto power = [](const int n)
  { return [n](const Complex value, const double omega) { return value * std::pow(Complex(0, omega), n); }; };
  FrequencyData data = changed(ring_at_rest(), power(-1));
  const auto labelled = [&](const unsigned int derivative)
  {
    for (FrequencyData::Entry &entry : data.entries)
      entry.derivative = derivative;
    return judge_data(data, false, 0).complaint;
  };
  // receptance labelled mobility, and so on: the values were divided by (j omega)^derivative
  expect_words(labelled(1), {"probably they are receptances"});
  data = changed(ring_at_rest(), power(-2));
  expect_words(labelled(2), {"probably they are receptances"});
  data = changed(ring_at_rest(), power(1));
  expect_words(labelled(0), {"probably they are mobilities"});
  data = changed(ring_at_rest(), power(-1));
  expect_words(labelled(2), {"probably they are mobilities"});
  data = changed(ring_at_rest(), power(1));
  expect_words(labelled(1), {"probably they are accelerances"});
  data = changed(ring_at_rest(), power(2));
  expect_words(labelled(0), {"probably they are accelerances"});
  data = changed(ring_at_rest(), [](const Complex value, double) { return std::conj(value); });
  expect_words(labelled(0), {"probably they are for e^{-j omega t}", "wrong sign"});
}

// Of a rolling ring the matrix gains energy on many lines, its driving points do not.
TEST(DataPassivity, RollingRingsAreNotRefused)
{
  RingParameters ring;
  ring.residual = false;
  const std::vector<RingRow> rows = ring_rows(ring, false);
  for (const double speed : {22., 50., 70.})
  {
    const FrequencyData data = data_of(
        3, 1000, 5,
        [&](const unsigned int i, const unsigned int j, const double omega)
        { return Complex(ring_receptance(ring, rows, -speed / ring.radius, RingFrame::road, omega)(i, j)); },
        true);
    EXPECT_EQ(judge_data(data, true, 0).complaint, "") << speed;
    EXPECT_EQ(judge_data(data, true, 0).gaining, 0) << speed;
    expect_words(judge_data(delayed(data, 1e-3), true, 0).complaint, {"driving point", "a delay of"});
    expect_words(judge_data(changed(data, [](const Complex value, const double omega)
                                    { return value / Complex(0, omega); }),
                            true, 0)
                     .complaint,
                 {"driving point"});
  }
}

TEST(DataPassivity, NonnegativeMinimum)
{
  // x >= 0 nearest to (1, -2, 3) in a skew metric: by its conditions
  DenseMatrix K(3);
  const double values[3][3] = {{4, 1, 0.5}, {1, 3, -1}, {0.5, -1, 2}};
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      K(i, j) = values[i][j];
  for (const std::vector<double> &h : {std::vector<double>{1, -2, 3}, {-1, -1, -1}, {5, 5, 5}, {-3, 4, -2}})
  {
    const std::vector<double> x = nonnegative_minimum(K, h);
    for (unsigned int i = 0; i < 3; ++i)
    {
      double slope = -h[i];
      for (unsigned int j = 0; j < 3; ++j)
        slope += K(i, j) * x[j];
      EXPECT_GE(x[i], 0);
      EXPECT_GT(slope, -1e-10);
      EXPECT_NEAR(slope * x[i], 0, 1e-10);
    }
  }
}

namespace
{
  const EntryMap toeplitz = {3, {0, 1, 2, 1, 0, 1, 2, 1, 0}};

  /// largest eigenvalue of Im G over |G|, on a grid of its own
  double largest_gain(const PoleFit &fit, const EntryMap &map)
  {
    double result = -1;
    DenseMatrix imaginary(map.n_rows, map.n_rows), vectors;
    for (double omega = 1; omega < 1e8; omega *= 1.003)
    {
      double size = 0;
      for (unsigned int i = 0; i < map.entry.size(); ++i)
      {
        const Complex value = fit.value(map.entry[i], omega);
        imaginary(i / map.n_rows, i % map.n_rows) = value.imag();
        size += std::norm(value);
      }
      result = std::max(result, symmetric_eigenvalues(imaginary, vectors).back() / std::sqrt(size));
    }
    return result;
  }
} // namespace

TEST(DataPassivity, FitsOfTheRingBecomePassive)
{
  const Spectra clean = ring_data::spectra();
  for (const bool zero : {false, true})
    for (const unsigned int n_pairs : {12u, 20u})
      for (const double noise : {0., 0.01})
      {
        const Spectra data = noise > 0 ? ring_data::with_noise(clean, noise, 1) : clean;
        VectorFittingOptions options;
        options.rules.zero_initial_value = zero;
        const PoleFit fit = vector_fit(data, n_pairs, options);
        const PassiveFit passive = nearest_passive_fit(data, fit, toeplitz, options.rules);
        std::printf(
            "%u pairs, zero %d, noise %g: gain %.1e to %.1e, change %.2e, %u rounds, E %.3e to %.3e\n",
            n_pairs, zero, noise, passive.gain_before, passive.gain, passive.change, passive.n_rounds,
            worst_error(data, fit), worst_error(data, passive.fit));
        EXPECT_TRUE(passive.is_passive());
        EXPECT_LT(largest_gain(passive.fit, toeplitz), 1e-5);
        EXPECT_LT(passive.change, 0.02);
        for (unsigned int i = 0; zero && i < 3; ++i)
          EXPECT_NEAR(passive.fit.initial(i, 0) / std::abs(fit.residues[i][0]), 0, 1e-9);
      }
}

// One residue that may change, Im R of a lone pole with g(0+) = 0: the nearest passive model is known.
TEST(DataPassivity, NearestPassiveModel)
{
  PoleFit fit;
  fit.poles = {{-30, 900}, {-50, 2000}};
  fit.residues = {{{0, -1}, {0, 0.02}}};
  fit.direct = {0};
  Spectra data;
  data.values.resize(1);
  for (unsigned int l = 0; l < 800; ++l)
  {
    data.omega.push_back(5. * l);
    data.values[0].push_back(fit.value(0, data.omega.back()));
  }
  ResidueRules rules;
  rules.real_amplitudes = true;
  const PassiveFit passive = nearest_passive_fit(data, fit, {1, {0}}, rules);
  EXPECT_TRUE(passive.is_passive());
  EXPECT_LT(largest_gain(passive.fit, {1, {0}}), 1.1e-7);
  // with real amplitudes a_k = -2 omega_k Im R_k power is 2 c_k a_k w^2 / |..|^2 per mode: at infinity sum a_k c_k >= 0, near a
  // resonance its own a_k: the second has to rise to where its peak meets the tail of the first
  const double peak = -2 * passive.fit.residues[0][1].imag() * 2000;
  EXPECT_LT(peak, 0);
  EXPECT_GT(peak, -2 * 0.02 * 2000);
  // a passive fit stays as it is, bit by bit
  const PassiveFit again = nearest_passive_fit(data, passive.fit, {1, {0}}, rules);
  EXPECT_EQ(again.n_rounds, 0);
  EXPECT_EQ(again.fit.residues, passive.fit.residues);
}

TEST(DataPassivity, ModelsOfDataThatArePassiveAreToo)
{
  FrequencyData data = ring_at_rest();
  IdentificationParameters parameters;
  parameters.pairs = {12};
  const auto ignore = [](const Identification &) {};
  const Identification one = identify(parameters, data, ignore).front();
  EXPECT_TRUE(one.passivity_looked_at);
  EXPECT_FALSE(one.passivity_refused());
  EXPECT_LT(one.passivity.change, 0.02);
  EXPECT_LT(largest_gain(one.fit, entry_map(data)), 1e-5);
  // it is the model that contact gets
  const ComplexMatrix used = receptance(one.identified.model, 3e3);
  EXPECT_LT(std::abs(used(0, 2) - one.fit.value(2, 3e3)), 1e-9 * std::abs(used(0, 0)));
  EXPECT_EQ(one.errors, fit_errors(spectra(data), one.fit));
  // far from passive: refused, and left as fitted
  data = changed(data, [](const Complex value, const double omega)
                 { return value * std::polar(1., omega * 5e-4); });
  const Identification other = identify(parameters, data, ignore).front();
  EXPECT_TRUE(other.passivity_refused());
  parameters.rolling = true;
  EXPECT_FALSE(identify(parameters, data, ignore).front().passivity_looked_at);
}

TEST(DataPassivity, UndampedFitsComeToRest)
{
  for (const double zeta : {0., 1e-6, 1e-3})
  {
    Spectra data;
    data.values.resize(2);
    for (unsigned int l = 1; l <= 400; ++l)
    {
      const double omega = 2 * M_PI * l * 0.7;
      Complex sum = 0, other = 0;
      for (const double resonance : {205., 600., 1210.3})
      {
        const Complex one =
            1. / (resonance * resonance - omega * omega + Complex(0, 2 * zeta * resonance * omega));
        sum += one;
        other += resonance < 300 ? one : -one;
      }
      data.omega.push_back(omega);
      data.values[0].push_back(sum);
      data.values[1].push_back(other);
    }
    for (const unsigned int n_pairs : {3u, 4u, 6u, 10u})
    {
      const PoleFit fit = vector_fit(data, n_pairs);
      EXPECT_TRUE(fit.converged) << zeta << ", " << n_pairs << " pairs, E " << worst_error(data, fit);
      EXPECT_LT(worst_error(data, fit), 1e-6) << zeta << ", " << n_pairs;
    }
  }
}

TEST(DataPassivity, AFreeMassIsNotLate)
{
  // exactly real but for the digits of a file, or with a noise of 2e-4: fits with a delay and without it differ by rounding or noise
  for (const double noise : {0., 2e-4})
  {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    const FrequencyData data =
        data_of(1, 1000, 1,
                [&](unsigned int, unsigned int, const double omega)
                {
                  char text[32];
                  std::snprintf(text, sizeof text, "%.11e", -1 / (2 * omega * omega));
                  return std::atof(text) * (1. + noise * Complex(normal(random), normal(random)));
                });
    EXPECT_FALSE(judge_data(data, false, 0).is_late(1000)) << noise;
  }
}
