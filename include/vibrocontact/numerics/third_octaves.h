#pragma once

#include <vibrocontact/numerics/signal.h>

namespace vibrocontact
{
  /// A 1/3-octave band of IEC 61260-1 to base ten: centre 1000 Hz 10^(x / 10), x whole, edges at 10^(-1/20) and
  /// 10^(1/20) times that.
  struct ThirdOctave
  {
    /// 1, 1.25, 1.6, 2, 2.5, 3.15, 4, 5, 6.3, 8 times a power of ten; exact [Hz]
    double nominal, centre;
    /// [Hz]
    double lower, upper;
    /// of the signal within the band [unit of the signal]
    double rms;
    /// 20 log10(rms / 1 unit) [dB]
    double level() const;
  };

  /// The bands that lie within two frequencies [Hz], without a signal (rms 0).
  std::vector<ThirdOctave> third_octaves_within(double from, double to);

  /// The bands of a signal whose width is at least the distance 1 / duration of the spectrum's lines and which end
  /// below half the sampling rate.
  ///
  /// The weighted mean is taken off and a Hann window w put on; X_k is the Fourier transform (FFTW) of w (x - mean):
  ///
  ///   rms^2 = sum over the lines k of the band  2 |X_k|^2 / (n sum w^2)
  ///
  /// A line that an edge cuts gives its shares to both bands. By Parseval's theorem the squares of contiguous bands thus
  /// add up to the mean square, weighted by w^2, of the signal limited to them.
  std::vector<ThirdOctave> third_octaves(const Signal &signal);
} // namespace vibrocontact
