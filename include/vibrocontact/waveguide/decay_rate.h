#pragma once

#include <array>
#include <map>
#include <vector>

namespace vibrocontact
{
  /// Decay rate of a track after EN 15461 [dB/m] from the squares of responses A_j at places x_j, the first at the exciter:
  ///
  ///   4.343 / sum_j |A_j|^2 / |A_0|^2 dx_j,
  ///
  /// dx_j from midway to the place before up to midway to the next one; the first begins at its place, the last reaches as far
  /// beyond its place as before it. @param places ascending [m]
  double track_decay_rate(const std::vector<double> &places, const std::vector<double> &squares);

  /// The standard's 29 places in quarters of a span: by quarters to 2 spans, halves to 4, then ever fewer to 66.
  const std::vector<unsigned int> &decay_rate_grid();

  /// Squares of vertical and lateral responses at quarters of a span from the exciter on, by frequency [Hz].
  using DecayingResponses = std::map<double, std::array<std::vector<double>, 2>>;

  /// Decay rates of vertical and lateral motion in a third-octave band, on the standard's grid.
  struct BandDecayRates
  {
    double nominal = 0; ///< [Hz]
    /// frequencies inside of the band
    unsigned int n_frequencies = 0;
    std::array<double, 2> rates; ///< [dB/m]
  };

  /// Of the bands that lie within the frequencies: squares are integrated over each band along straight lines between the
  /// frequencies, place by place, as a measured response of the band is. @param spacing length of a span [m]
  std::vector<BandDecayRates> band_decay_rates(const DecayingResponses &responses, double spacing);

  /// Of one frequency and direction, at all quarters or on the standard's grid, as far as there are places.
  double decay_rate_at_quarters(const std::vector<double> &squares, double spacing);
  double decay_rate_on_grid(const std::vector<double> &squares, double spacing);
} // namespace vibrocontact
