#pragma once

#include <vibrocontact/marching/signal_windows.h>
#include <vibrocontact/numerics/signal.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// Reference of velocity levels, those of the rms value: 20 log10(v / 5e-8 m/s) [m/s].
  constexpr double velocity_reference = 5e-8;

  /// A quantity of a run over time.
  struct NamedSignal
  {
    std::string name, unit;
    Signal signal;
    /// a velocity that can be heard
    bool audible = false;
  };

  /// What is made of the signals of a run: for the object of its analysis in results.json
  ///
  /// - `dominant_frequencies_Hz`: peaks of the first signal's spectrum, the largest first
  /// - `signals[]`: `name`, `unit`, `varies`, `rms`, `slow_part`, `spectrum_window_s`, `peaks[]` (`frequency_Hz`, `amplitude`; at most ten
  ///   above 1 % of the largest), `cycle` (`frequency_Hz`, `amplitude`, `rms`, `drift`, `spread`, `periods`;
  ///   see CycleMeasure), `level_dB` and `level_reference_m_s` of a velocity (rms in the window of the spectrum),
  ///   `growth_window_s`, `growth[]` (`frequency_Hz`, `growth_1_s`, null where nothing grows or decays exponentially,
  ///   `amplitude`, `residual`; see GrowthFit), `growth_left_out[]` (peaks of that window with too few `periods` for a
  ///   fit: `frequency_Hz`, `amplitude`, `periods`, `periods_needed`), `sound` (`file`, `full_scale_m_s`)
  ///
  /// and the WAV files. A signal that does not vary (1e-9 of its size) has no peaks; neither has one that is
  /// constant over the last quarter of the window or more, an impact that is over: it has `constant_since_s`
  /// instead.
  /// @param end_of_growth end of the window of the growth rates if the parameters give none [s]
  /// @param folder of the WAV files, written by the calling rank; empty: none
  nlohmann::ordered_json signals_json(const std::vector<NamedSignal> &signals, const SignalWindows &windows,
                                      double end_of_growth, const std::string &folder);

  /// The signals that are not constant, the one with the largest rms about its mean first.
  std::vector<NamedSignal> by_strength(std::vector<NamedSignal> signals);

  /// 1/3-octave bands of the force of all contact points together, from the last three quarters of the run: nominal_Hz,
  /// centre_Hz, lower_Hz, upper_Hz, rms_N, level_dB (re 1 N); bands without any force are left out.
  /// @param file with its .csv @throws OutputError
  void write_third_octaves(const Signal &force, const std::string &file);
} // namespace vibrocontact
