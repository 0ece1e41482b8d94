#pragma once

#include <vibrocontact/numerics/signal.h>

namespace vibrocontact
{
  /// No spectrum is made of fewer.
  constexpr unsigned int least_samples_of_spectrum = 16;

  /// A line of a spectrum: frequency [Hz] and amplitude of its sine [unit of the signal].
  struct SpectralPeak
  {
    double frequency = 0, amplitude = 0;
  };

  /// The peaks of a signal's spectrum, the largest first.
  ///
  /// The mean is taken off, a Hann window put on and zeros appended to four times the length (FFTW); a peak
  /// is a sample of the spectrum larger than all within two of the window's resolutions (2 / duration), and a
  /// parabola through the logarithms of it and its neighbours gives its frequency and amplitude. A steady
  /// sine is found to 1e-3 / duration in frequency and to 1e-3 in amplitude; sines closer than 4 / duration
  /// are not told apart.
  /// What is smaller than 1e-3 of the signal's largest departure from its mean is no peak, a slow
  /// drift has none.
  /// @param n at most so many peaks; @param floor those smaller than this share of the largest are left out
  std::vector<SpectralPeak> spectral_peaks(const Signal &signal, unsigned int n = 10, double floor = 1e-2);

  /// Share of the mean square, under the same window, of motions slower than two periods in the signal's duration, which no peak is
  /// found of. The skirts of peaks are not counted. 0 of a constant signal and of too few samples.
  /// @param peaks spectral_peaks()
  double slow_part(const Signal &signal, const std::vector<SpectralPeak> &peaks);
} // namespace vibrocontact
