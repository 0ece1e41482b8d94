/// Noise on frequency responses, for tests of how data are judged.
#pragma once

#include <vibrocontact/receptances/frequency_data.h>

#include <cmath>
#include <complex>
#include <random>

namespace vibrocontact
{
  /// Complex Gaussian noise of a share of each entry's rms.
  inline FrequencyData noisy(FrequencyData data, const double share, const unsigned int seed)
  {
    std::mt19937_64 generator(seed);
    std::normal_distribution<double> normal;
    for (FrequencyData::Entry &entry : data.entries)
    {
      double square = 0;
      for (const std::complex<double> &value : entry.values)
        square += std::norm(value);
      for (std::complex<double> &value : entry.values)
      {
        const double real = normal(generator);
        value += share * std::sqrt(square / entry.values.size() / 2) *
                 std::complex<double>(real, normal(generator));
      }
    }
    return data;
  }
} // namespace vibrocontact
