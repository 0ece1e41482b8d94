#pragma once

#include <cmath>
#include <vector>

namespace vibrocontact
{
  /// Growth of one motion from its amplitude over time, log a = log a_0 + growth t by least squares.
  struct AmplitudeGrowth
  {
    /// and how far off it may be, what leaves the line taken as a slow wave: residual over the rms of the times [1/s]
    double growth = 0, uncertainty = 0;
    /// rms of what log a is off the line [-]: 0.01 is one percent of the amplitude
    double residual = 0;
    unsigned int n_samples = 0;
    /// a line within a few percent that is longer than its waves, on eight samples or more
    bool is_exponential() const
    {
      return n_samples >= 8 && residual <= 0.05 && uncertainty <= 0.3 * std::abs(growth);
    }
  };

  /// Of the samples from one time to another [s].
  AmplitudeGrowth amplitude_growth(const std::vector<double> &times, const std::vector<double> &amplitudes,
                                   double from, double to);
} // namespace vibrocontact
