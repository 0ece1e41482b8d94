#include <vibrocontact/numerics/cycle_measure.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  CycleMeasure measure_cycle(const Signal &signal, const double frequency, const unsigned int n)
  {
    CycleMeasure result;
    const double samples = 1 / (frequency * signal.step); // per period
    if (!(frequency > 0) || samples < 4 || signal.size() < 2 * samples)
      return result;
    result.n_periods = std::min<double>(n, std::floor((signal.size() - 1) / samples));
    const std::size_t last = signal.size() - 1;
    const auto place = [&](const unsigned int period)
    { return last - std::size_t(std::llround((result.n_periods - period) * samples)); };

    const auto extreme = [&](const std::size_t i)
    {
      const std::vector<double> &y = signal.values;
      return i == 0 || i == last ? y[i] : extreme_between_samples(y[i - 1], y[i], y[i + 1]);
    };
    std::vector<double> amplitudes;
    for (unsigned int p = 0; p < result.n_periods; ++p)
    {
      const auto begin = signal.values.begin() + place(p), end = signal.values.begin() + place(p + 1) + 1;
      const auto [low, high] = std::minmax_element(begin, end);
      amplitudes.push_back((extreme(high - signal.values.begin()) - extreme(low - signal.values.begin())) /
                           2);
      result.amplitude += amplitudes.back() / result.n_periods;
    }
    double mean = 0, square = 0;
    const double count = last - place(0);
    for (std::size_t i = place(0); i < last; ++i)
    {
      mean += signal.values[i] / count;
      square += signal.values[i] * signal.values[i] / count;
    }
    result.rms = std::sqrt(std::max(0., square - mean * mean));
    if (!(result.amplitude > 0))
      return result;
    // what has died away has no logarithm
    constexpr double least_part = 1e-12;
    const double least = least_part * *std::max_element(amplitudes.begin(), amplitudes.end());
    std::vector<double> logarithms;
    for (const double amplitude : amplitudes)
    {
      logarithms.push_back(std::log(std::max(amplitude, least)));
      result.spread = std::max(result.spread, std::abs(amplitude / result.amplitude - 1));
    }
    // means of neighbours: a motion that repeats itself every second period does not drift
    if (logarithms.size() > 2)
    {
      for (std::size_t p = 0; p + 1 < logarithms.size(); ++p)
        logarithms[p] = (logarithms[p] + logarithms[p + 1]) / 2;
      logarithms.pop_back();
    }
    double above = 0, below = 0;
    for (std::size_t p = 0; p < logarithms.size(); ++p)
    {
      const double x = p - (logarithms.size() - 1) / 2.;
      above += x * logarithms[p];
      below += x * x;
    }
    result.drift = below > 0 ? std::expm1(above / below * result.n_periods) : 0;
    return result;
  }
} // namespace vibrocontact
