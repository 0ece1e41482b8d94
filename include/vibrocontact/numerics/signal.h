#pragma once

#include <vector>

namespace vibrocontact
{
  /// Equally spaced samples of a quantity over time [s].
  struct Signal
  {
    /// time of the first sample, distance of the samples [s]
    double begin = 0, step = 1;
    std::vector<double> values;

    std::size_t size() const { return values.size(); }
    double time(const std::size_t i) const { return begin + i * step; }
    /// time of the last sample
    double end() const { return values.empty() ? begin : time(values.size() - 1); }
  };

  /// A signal from samples at ascending times: as they are if they are equally spaced to 1e-6 of their
  /// distance, otherwise interpolated by cubics (Hermite, slopes from the neighbours) at their median
  /// distance.
  Signal equally_spaced(const std::vector<double> &times, const std::vector<double> &values);

  /// The samples from one time to another, both included.
  Signal part(const Signal &signal, double from, double to);

  /// The signal at another rate [1/s]: its Fourier transform, cut with a half-cosine flank from 0.92 to 1
  /// times half the lower of the two rates, so that nothing above folds back. The signal is taken as zero
  /// outside; both ends are faded over `fade` [s] first.
  Signal resampled(const Signal &signal, double rate, double fade = 0);
} // namespace vibrocontact
