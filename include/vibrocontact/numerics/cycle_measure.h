#pragma once

#include <vibrocontact/numerics/signal.h>

namespace vibrocontact
{
  /// Of a largest or smallest sample and its neighbours the vertex of the parabola through them.
  inline double extreme_between_samples(const double before, const double extreme, const double after)
  {
    const double slope = (after - before) / 2, bend = after - 2 * extreme + before;
    return bend == 0 ? extreme : extreme - slope * slope / (2 * bend);
  }

  /// How steady an oscillation is over its last periods.
  struct CycleMeasure
  {
    /// half the distance from least to largest value, mean over the periods; root of the mean square about
    /// the mean [unit of the signal]
    double amplitude = 0, rms = 0;
    /// change of the amplitude over these periods, over that at their beginning, by a straight line through the logarithms
    /// of the amplitudes of each, neighbours averaged [-]: above -1 however fast they decay
    double drift = 0;
    /// largest difference of a period's amplitude from their mean, over the mean [-]: a beat shows here
    double spread = 0;
    /// periods that were looked at; 0: the signal is too short
    unsigned int n_periods = 0;
  };

  /// The last periods of the given frequency [Hz], at most n of them.
  CycleMeasure measure_cycle(const Signal &signal, double frequency, unsigned int n = 20);
} // namespace vibrocontact
