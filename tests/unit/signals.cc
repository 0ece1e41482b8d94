// Signals with a known answer: spectrum, growth, steadiness, another sampling rate.

#include "pi.h"

#include <vibrocontact/analyses/limit_cycle/cycle_period.h>
#include <vibrocontact/marching/signal_output.h>
#include <vibrocontact/numerics/cycle_measure.h>
#include <vibrocontact/numerics/growth_fit.h>
#include <vibrocontact/numerics/spectrum.h>
#include <vibrocontact/numerics/third_octaves.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;

namespace
{
  struct Sine
  {
    double frequency, growth, amplitude, phase;
  };

  Signal sum_of(const std::vector<Sine> &sines, const double step, const double duration)
  {
    Signal signal;
    signal.begin = 0.3;
    signal.step = step;
    for (std::size_t i = 0; i < std::size_t(duration / step); ++i)
    {
      double value = 0;
      for (const Sine &s : sines)
        value +=
            s.amplitude * std::exp(s.growth * i * step) * std::cos(two_pi * s.frequency * i * step + s.phase);
      signal.values.push_back(value);
    }
    return signal;
  }
} // namespace

TEST(Signals, PeaksOfSteadySines)
{
  const double duration = 0.1;
  const auto peaks = spectral_peaks(sum_of(
      {{334.17, 0, 2, 0.3}, {918.73, 0, 5, 1.1}, {1837.46, 0, 0.5, 2}, {3417, 0, 1e-4, 0}}, 4e-6, duration));
  ASSERT_EQ(peaks.size(), 3u); // the last is below the floor
  EXPECT_NEAR(peaks[0].frequency, 918.73, 2e-3 / duration);
  EXPECT_NEAR(peaks[1].frequency, 334.17, 2e-3 / duration);
  EXPECT_NEAR(peaks[2].frequency, 1837.46, 2e-3 / duration);
  EXPECT_NEAR(peaks[0].amplitude, 5, 5e-3);
  EXPECT_NEAR(peaks[1].amplitude, 2, 4e-3);
  EXPECT_NEAR(peaks[2].amplitude, 0.5, 1e-3);
  // a drift with a little noise is no oscillation
  Signal drift = sum_of({{20000, 0, 1e-5, 0}}, 4e-6, duration);
  for (std::size_t i = 0; i < drift.size(); ++i)
    drift.values[i] += std::exp(-30. * i * drift.step);
  EXPECT_TRUE(spectral_peaks(drift).empty());
}

TEST(Signals, GrowthOfSinesBesideEachOther)
{
  // the paper's four modes with growth rates of some 1/s, a decaying neighbour 3 Hz away, a rail mode, an offset
  const double duration = 0.2;
  const std::vector<Sine> sines = {{334, 8, 1e-3, 0.1}, {918, 3, 3e-3, 1},   {1670, 2, 1e-4, 2},
                                   {3417, 5, 2e-5, 3},  {921, -30, 1e-3, 0}, {1065, -700, 1e-2, 0},
                                   {0, 0, 0.5, 0}};
  const Signal signal = sum_of(sines, 4e-6, duration);
  for (unsigned int k = 0; k < 4; ++k)
  {
    const GrowthFit fit = fit_growth(signal, sines[k].frequency + 0.7);
    std::printf("%g Hz: %.6f Hz, growth %.6f instead of %g, amplitude %.4g instead of %.4g, residual %.1e\n",
                sines[k].frequency, fit.frequency, fit.growth, sines[k].growth, fit.amplitude,
                sines[k].amplitude * std::exp(sines[k].growth * duration / 2), fit.residual);
    EXPECT_NEAR(fit.frequency, sines[k].frequency, 1e-3);
    EXPECT_NEAR(fit.growth, sines[k].growth, 1e-2);
    EXPECT_NEAR(fit.amplitude / (sines[k].amplitude * std::exp(sines[k].growth * duration / 2)), 1, 1e-3);
  }
  EXPECT_EQ(fit_growth(Signal{0, 1e-5, std::vector<double>(5000, 0.)}, 1000).amplitude, 0);
}

TEST(Signals, GrowthsAtThePeaks)
{
  const auto fits = fit_growths(sum_of({{334, 8, 1e-3, 0.1}, {918, -3, 5e-3, 1}}, 1e-5, 0.2));
  ASSERT_EQ(fits.size(), 2u);
  EXPECT_NEAR(fits[0].frequency, 918, 1e-3);
  EXPECT_NEAR(fits[0].growth, -3, 1e-3);
  EXPECT_NEAR(fits[1].growth, 8, 1e-3);
}

TEST(Signals, GrowthOfFewPeriodsAndWhatIsTooShort)
{
  // 11 periods on a load 50 times as large, beside a decaying motion
  const std::vector<Sine> sines = {{917, 10, 1e-2, 0.4}, {1962, -80, 3e-5, 1}, {0, 0, 0.5, 0}};
  const auto fits = fit_growths(sum_of(sines, 1e-6, 0.012));
  ASSERT_FALSE(fits.empty());
  std::printf("%.6f Hz, growth %.6f, amplitude %.6g\n", fits[0].frequency, fits[0].growth, fits[0].amplitude);
  EXPECT_NEAR(fits[0].frequency, 917, 1e-2);
  EXPECT_NEAR(fits[0].growth, 10, 1e-2);
  EXPECT_NEAR(fits[0].amplitude / (1e-2 * std::exp(10 * 0.006)), 1, 1e-3);
  EXPECT_TRUE(peaks_too_short_for_growth(sum_of(sines, 1e-6, 0.012)).empty());
  const auto left_out = peaks_too_short_for_growth(sum_of(sines, 1e-6, 0.010));
  ASSERT_EQ(left_out.size(), 1u);
  EXPECT_NEAR(left_out[0].frequency, 917, 5);
  EXPECT_NEAR(left_out[0].amplitude / 1e-2, 1, 0.1);
}

TEST(Signals, AnImpactThatIsOverIsNoOscillation)
{
  // half sine pulses of 5 ms up to 0.6 s of 1 s, nothing afterwards: the window of the spectrum is the second half
  Signal force = sum_of({{100, 0, 100, 0}}, 1e-4, 1);
  for (std::size_t i = 0; i < force.size(); ++i)
    force.values[i] = i < 6000 ? std::max(0., force.values[i]) : 0;
  NamedSignal signal;
  signal.name = "normal_force";
  signal.unit = "N";
  signal.signal = force;
  const auto json = signals_json({signal}, SignalWindows(), force.end(), "");
  EXPECT_TRUE(json.at("dominant_frequencies_Hz").empty());
  EXPECT_TRUE(json.at("signals")[0].at("peaks").empty());
  EXPECT_FALSE(json.at("signals")[0].contains("cycle"));
  EXPECT_NEAR(json.at("signals")[0].at("constant_since_s").get<double>(), force.begin + 0.6, 6e-3);
}

TEST(Signals, MotionThatIsTooSlowForTheWindow)
{
  const auto slow = [](const Signal &signal) { return slow_part(signal, spectral_peaks(signal)); };
  // 100 periods of 500 Hz, alone, growing and decaying by e^5, as ten harmonics and more
  EXPECT_LT(slow(sum_of({{200, 0, 1, 0}, {500, 0, 0.5, 0}}, 1e-4, 0.2)), 1e-3);
  EXPECT_LT(slow(sum_of({{500, 25, 1, 0}}, 1e-4, 0.2)), 1e-3);
  EXPECT_LT(slow(sum_of({{500, -25, 1, 0}}, 1e-4, 0.2)), 1e-3);
  std::vector<Sine> pulses;
  for (unsigned int k = 1; k <= 30; ++k)
    pulses.push_back({100. * k, 0, 1, 0});
  EXPECT_LT(slow(sum_of(pulses, 1e-4, 0.2)), 1e-3);
  // two periods and a half are a line, one and a half or a drift are none
  EXPECT_LT(slow(sum_of({{12.5, 0, 1, 0}, {500, 0, 0.5, 0}}, 1e-4, 0.2)), 1e-2);
  EXPECT_GT(slow(sum_of({{7.5, 0, 1, 0}, {500, 0, 0.5, 0}}, 1e-4, 0.2)), 0.5);
  EXPECT_LT(slow(sum_of({{7.5, 0, 0.1, 0}, {500, 0, 0.5, 0}}, 1e-4, 0.2)), 0.05);
  Signal drift = sum_of({{500, 0, 0.1, 0}}, 1e-4, 0.2);
  for (std::size_t i = 0; i < drift.size(); ++i)
    drift.values[i] += 10 * drift.time(i);
  EXPECT_GT(slow(drift), 0.6);
  EXPECT_EQ(slow(Signal()), 0);
}

TEST(Signals, SteadinessOfACycle)
{
  // steady, with harmonics
  const CycleMeasure steady = measure_cycle(sum_of({{919, 0, 3, 0}, {1838, 0, 1, 0}}, 1e-6, 0.05), 919);
  EXPECT_EQ(steady.n_periods, 20u);
  EXPECT_NEAR(steady.drift, 0, 1e-5);
  EXPECT_NEAR(steady.spread, 0, 1e-4);
  EXPECT_NEAR(steady.rms, std::sqrt(5.), 1e-3);
  // least value -3 cos - cos 2: at cos = -3/4, -2.125; largest 4
  EXPECT_NEAR(steady.amplitude, (4 + 2.125) / 2, 1e-4);
  // growing by 2 1/s: 20 periods are 20 / 919 s
  const CycleMeasure growing = measure_cycle(sum_of({{919, 2, 3, 0}}, 1e-6, 0.05), 919);
  EXPECT_NEAR(growing.drift, std::expm1(2 * 20 / 919.), 1e-4);
  // fast ones by their exponential: no amplitude falls by more than itself
  EXPECT_NEAR(measure_cycle(sum_of({{919, 100, 3, 0}}, 1e-6, 0.05), 919).drift / std::expm1(2000 / 919.), 1,
              1e-2);
  EXPECT_NEAR(measure_cycle(sum_of({{919, -200, 3, 0}}, 1e-6, 0.05), 919).drift, std::expm1(-4000 / 919.),
              1e-3);
  EXPECT_EQ(measure_cycle(sum_of({{919, 0, 3, 0}}, 1e-6, 1e-3), 919).n_periods, 0u);
  // every second period is larger: no drift, and a growth beside it is found
  const CycleMeasure doubled = measure_cycle(sum_of({{919, 0, 3, 0}, {459.5, 0, 0.1, 1}}, 1e-6, 0.05), 919);
  EXPECT_GT(doubled.spread, 5e-3);
  EXPECT_LT(std::abs(doubled.drift), 1e-3 * doubled.spread);
}

TEST(Signals, AmplitudeOfACycleOfFewSteps)
{
  // the samples of 24 steps miss the peaks by up to 0.86 %
  for (const double place : {0., 0.25, 0.5})
  {
    CycleSignal sine{"", {}, true};
    for (unsigned int j = 0; j < 24; ++j)
      sine.values.push_back(3 + 2 * std::sin((j + place) * two_pi / 24));
    EXPECT_NEAR(sine.amplitude(), 2, 2 * 1.2e-4) << place;
  }
  EXPECT_EQ((CycleSignal{"", {4, 4, 4, 4}, true}).amplitude(), 0);
  // a force that is zero for a while has a corner there, and no value below it
  EXPECT_EQ((CycleSignal{"", {0, 0, 0, 0.3, 1, 0.3}}).amplitude(), 0.5);
}

TEST(Signals, AnotherRateKeepsSinesAndFoldsNothing)
{
  const double step = 1.7e-6, rate = 48000;
  const Signal audible = sum_of({{919, 0, 3, 0.4}, {15000, 0, 1, 0}}, step, 0.1);
  const Signal out = resampled(audible, rate, 2e-3);
  EXPECT_NEAR(out.size(), 0.1 * rate, 2);
  // away from the ends the sines themselves
  double worst = 0;
  for (std::size_t i = 1000; i + 1000 < out.size(); ++i)
  {
    const double t = i / rate;
    worst = std::max(
        worst, std::abs(out.values[i] - 3 * std::cos(two_pi * 919 * t + 0.4) - std::cos(two_pi * 15000 * t)));
  }
  EXPECT_LT(worst, 1e-3);
  // 40 kHz would be heard at 8 kHz
  const Signal ultrasonic = resampled(sum_of({{40000, 0, 1, 0}}, step, 0.1), rate, 2e-3);
  for (std::size_t i = 1000; i + 1000 < ultrasonic.size(); ++i)
    ASSERT_LT(std::abs(ultrasonic.values[i]), 1e-4);
  // to a higher rate
  const Signal coarse = resampled(sum_of({{500, 0, 1, 0}}, 1e-4, 0.2), rate, 2e-3);
  for (std::size_t i = 3000; i + 3000 < coarse.size(); ++i)
    ASSERT_NEAR(coarse.values[i], std::cos(two_pi * 500 * i / rate), 2e-3);
}

TEST(Signals, UnequalSteps)
{
  std::vector<double> times, values;
  for (unsigned int i = 0; i < 4000; ++i)
  {
    times.push_back(1e-5 * (i + 0.3 * std::sin(0.37 * i)));
    values.push_back(std::sin(two_pi * 700 * times.back()));
  }
  const Signal signal = equally_spaced(times, values);
  for (std::size_t i = 10; i + 10 < signal.size(); ++i)
    ASSERT_NEAR(signal.values[i], std::sin(two_pi * 700 * signal.time(i)), 1e-4);
  const Signal middle = part(signal, 0.01, 0.02);
  EXPECT_NEAR(middle.begin, 0.01, 2e-5);
  EXPECT_NEAR(middle.end(), 0.02, 2e-5);
}

// Bands of IEC 61260-1: names and edges; a sine lies in its own band; Parseval: contiguous bands add up to the mean square of the
// signal limited to them, weighted as the window weighs.
TEST(Signals, ThirdOctaves)
{
  const double step = 1e-4;
  const std::size_t n = 5000;
  const auto sine = third_octaves(sum_of({{1000, 0, 3, 0.4}}, step, (n + 0.5) * step));
  double before = 0;
  for (const ThirdOctave &band : sine)
  {
    EXPECT_NEAR(std::log10(band.upper / band.lower), 0.1, 1e-12);
    EXPECT_NEAR(band.nominal / band.centre, 1, 0.015);
    if (before > 0)
      EXPECT_NEAR(band.lower / before, 1, 1e-12);
    before = band.upper;
    const bool own = band.nominal == 1000;
    EXPECT_NEAR(band.rms, own ? 3 / std::sqrt(2.) : 0., 1e-4) << band.nominal;
    if (own)
      EXPECT_NEAR(band.level(), 20 * std::log10(3 / std::sqrt(2.)), 1e-3);
  }
  EXPECT_GT(sine.back().upper, 3900);
  EXPECT_LE(sine.back().upper, 5000);

  // steps and jumps with a mean; limited to the bands by a plain sum over the frequencies
  Signal rough;
  rough.step = step;
  std::uint32_t state = 7;
  for (std::size_t i = 0; i < 1200; ++i)
  {
    state = 1664525u * state + 1013904223u;
    rough.values.push_back(5 + (i % 97 < 40 ? 2. : 0.) + 1e-9 * state);
  }
  const auto bands = third_octaves(rough);
  double sum = 0;
  for (const ThirdOctave &band : bands)
    sum += band.rms * band.rms;
  const std::size_t m = rough.size();
  std::vector<double> window(m), windowed(m), limited(m, 0.);
  double weights = 0, squares = 0, mean = 0;
  for (std::size_t i = 0; i < m; ++i)
  {
    window[i] = std::pow(std::sin(two_pi / 2 * i / m), 2);
    weights += window[i];
    squares += window[i] * window[i];
    mean += window[i] * rough.values[i];
  }
  for (std::size_t i = 0; i < m; ++i)
    windowed[i] = window[i] * (rough.values[i] - mean / weights);
  for (std::size_t k = 1; k < m / 2; ++k)
  {
    // the share of the line within the bands, as an amplitude
    const double low = bands.front().lower * m * step, high = bands.back().upper * m * step;
    const double share = std::clamp(std::min(k + 0.5, high) - std::max(k - 0.5, low), 0., 1.);
    double real = 0, imaginary = 0;
    for (std::size_t i = 0; i < m; ++i)
    {
      real += windowed[i] * std::cos(two_pi * k * i / m);
      imaginary += windowed[i] * std::sin(two_pi * k * i / m);
    }
    for (std::size_t i = 0; i < m; ++i)
      limited[i] += std::sqrt(share) * 2 / m *
                    (real * std::cos(two_pi * k * i / m) + imaginary * std::sin(two_pi * k * i / m));
  }
  double square = 0;
  for (const double value : limited)
    square += value * value / squares;
  EXPECT_GT(square, 0.5);
  EXPECT_NEAR(sum / square, 1, 1e-10);
}
