#pragma once

#include <vibrocontact/numerics/signal.h>
#include <vibrocontact/numerics/spectrum.h>

namespace vibrocontact
{
  /// One motion a exp(growth t) cos(2 pi frequency t + phase) found in a signal.
  struct GrowthFit
  {
    /// [Hz], [1/s]
    double frequency = 0, growth = 0;
    /// amplitude at the middle of the window [unit of the signal]
    double amplitude = 0;
    /// what the motions found near this frequency leave of the signal there, rms over rms [-]; large: not
    /// a sum of growing and decaying sines
    double residual = 0;
    /// Whether the growth means anything: what grows exponentially for the whole window leaves 1e-3 and less, an
    /// amplitude that turns, saturates or comes out of noise some tenths.
    bool is_exponential() const { return residual <= 0.05; }
  };

  /// The strongest motion near a frequency.
  ///
  /// The signal is shifted by -frequency, low-passed by a Kaiser window (stop band 1e-7) a quarter as long as
  /// the signal and kept at 64 instants, in which an exponential stays exactly an exponential; the matrix
  /// pencil (Hua, Sarkar 1990; total least squares, LAPACK's singular values) then resolves the motions of
  /// this band, about +- 21 / duration, beside each other. Growth is exact to some 1e-3 / duration for a
  /// linear system.
  /// @return amplitude 0 if the signal is too short or zero
  GrowthFit fit_growth(const Signal &signal, double frequency);

  /// Periods that a fit needs: with fewer the opposite of the motion, twice its frequency away, is in the band.
  constexpr double least_periods_of_growth = 10.5;

  /// The motions at the peaks of the signal's spectrum, one fit per peak, the strongest first.
  std::vector<GrowthFit> fit_growths(const Signal &signal, unsigned int n = 6);

  /// The peaks of which the signal is too short to fit a growth, the strongest first.
  std::vector<SpectralPeak> peaks_too_short_for_growth(const Signal &signal, unsigned int n = 6);
} // namespace vibrocontact
