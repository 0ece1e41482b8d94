#include <vibrocontact/base/table.h>
#include <vibrocontact/marching/signal_output.h>
#include <vibrocontact/marching/sound.h>
#include <vibrocontact/numerics/cycle_measure.h>
#include <vibrocontact/numerics/growth_fit.h>
#include <vibrocontact/numerics/spectrum.h>
#include <vibrocontact/numerics/third_octaves.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vibrocontact
{
  namespace
  {
    bool varies(const Signal &signal)
    {
      if (signal.size() < least_samples_of_spectrum)
        return false;
      const double mean =
          std::accumulate(signal.values.begin(), signal.values.end(), 0.) / double(signal.size());
      double largest = 0, size = 0;
      for (const double value : signal.values)
      {
        largest = std::max(largest, std::abs(value - mean));
        size = std::max(size, std::abs(value));
      }
      return largest > 1e-9 * size;
    }

    /// Since when the signal is constant, its end if it is not.
    double constant_since(const Signal &signal)
    {
      double size = 0;
      for (const double value : signal.values)
        size = std::max(size, std::abs(value));
      std::size_t i = signal.size() - 1;
      while (i > 0 && std::abs(signal.values[i - 1] - signal.values.back()) <= 1e-9 * size)
        --i;
      return signal.time(i);
    }

    /// Rms about the mean.
    double rms(const Signal &signal)
    {
      const double mean =
          std::accumulate(signal.values.begin(), signal.values.end(), 0.) / double(signal.size());
      double square = 0;
      for (const double value : signal.values)
        square += (value - mean) * (value - mean);
      return std::sqrt(square / double(signal.size()));
    }

    nlohmann::ordered_json growth_json(const GrowthFit &fit)
    {
      nlohmann::ordered_json json = {{"frequency_Hz", fit.frequency},
                                     {"growth_1_s", fit.growth},
                                     {"amplitude", fit.amplitude},
                                     {"residual", fit.residual}};
      if (!fit.is_exponential())
        json["growth_1_s"] = nullptr;
      return json;
    }

    nlohmann::ordered_json cycle_json(const CycleMeasure &cycle, const double frequency)
    {
      return {{"frequency_Hz", frequency}, {"amplitude", cycle.amplitude}, {"rms", cycle.rms},
              {"drift", cycle.drift},      {"spread", cycle.spread},       {"periods", cycle.n_periods}};
    }
  } // namespace

  nlohmann::ordered_json signals_json(const std::vector<NamedSignal> &signals, const SignalWindows &windows,
                                      const double end_of_growth, const std::string &folder)
  {
    using Json = nlohmann::ordered_json;
    Json result = {{"dominant_frequencies_Hz", Json::array()}, {"signals", Json::array()}};
    for (const NamedSignal &one : signals)
    {
      const Signal &all = one.signal;
      const double duration = all.end() - all.begin;
      const Signal late =
          part(all, all.end() - (windows.spectrum_duration > 0 ? windows.spectrum_duration : duration / 2),
               all.end());
      const Signal early =
          part(all, windows.growth_begin, windows.growth_end > 0 ? windows.growth_end : end_of_growth);
      Json json = {{"name", one.name},
                   {"unit", one.unit},
                   {"spectrum_window_s", {late.begin, late.end()}},
                   {"peaks", Json::array()}};
      const double still = varies(late) ? constant_since(late) : late.end();
      if (late.end() - still > 0.25 * (late.end() - late.begin))
        json["constant_since_s"] = still; // an impact that is over, no oscillation
      else if (varies(late))
      {
        json["varies"] = true;
        const auto peaks = spectral_peaks(late);
        for (const SpectralPeak &peak : peaks)
        {
          json["peaks"].push_back({{"frequency_Hz", peak.frequency}, {"amplitude", peak.amplitude}});
          if (&one == &signals.front())
            result["dominant_frequencies_Hz"].push_back(peak.frequency);
        }
        const double size = rms(late);
        json["slow_part"] = slow_part(late, peaks);
        json["rms"] = size;
        if (!peaks.empty())
        {
          const CycleMeasure cycle = measure_cycle(late, peaks.front().frequency);
          if (cycle.n_periods > 0)
            json["cycle"] = cycle_json(cycle, peaks.front().frequency);
        }
        if (one.unit == "m/s")
        {
          json["level_dB"] = 20 * std::log10(size / velocity_reference);
          json["level_reference_m_s"] = velocity_reference;
        }
      }
      json["growth_window_s"] = {early.begin, early.end()};
      json["growth"] = Json::array();
      json["growth_left_out"] = Json::array();
      if (varies(early))
      {
        for (const GrowthFit &fit : fit_growths(early))
          json["growth"].push_back(growth_json(fit));
        for (const SpectralPeak &peak : peaks_too_short_for_growth(early))
          json["growth_left_out"].push_back({{"frequency_Hz", peak.frequency},
                                             {"amplitude", peak.amplitude},
                                             {"periods", peak.frequency * (early.end() - early.begin)},
                                             {"periods_needed", least_periods_of_growth}});
      }
      if (one.audible && !folder.empty() && duration > least_sound && varies(all))
      {
        const std::string file = one.name + ".wav";
        json["sound"] = {{"file", file}, {"full_scale_m_s", write_sound(all, folder + "/" + file)}};
      }
      result["signals"].push_back(json);
    }
    return result;
  }

  std::vector<NamedSignal> by_strength(std::vector<NamedSignal> signals)
  {
    const auto is_constant = [](const NamedSignal &one) { return !(rms(one.signal) > 0); };
    signals.erase(std::remove_if(signals.begin(), signals.end(), is_constant), signals.end());
    std::stable_sort(signals.begin(), signals.end(),
                     [](const NamedSignal &a, const NamedSignal &b)
                     { return rms(a.signal) > rms(b.signal); });
    return signals;
  }

  void write_third_octaves(const Signal &force, const std::string &file)
  {
    Table table({"nominal_Hz", "centre_Hz", "lower_Hz", "upper_Hz", "rms_N", "level_dB"},
                {"1/3-octave bands (IEC 61260-1, base ten) of the force of all contact points together, mean "
                 "left out, Hann window over the last three quarters of the run",
                 "level re 1 N; the squares of contiguous bands add up to that of the whole"});
    Signal late = force;
    late.values.erase(late.values.begin(), late.values.begin() + late.size() / 4);
    for (const ThirdOctave &band : third_octaves(late))
      if (band.rms > 0)
        table.add_row({band.nominal, band.centre, band.lower, band.upper, band.rms, band.level()});
    table.write(file);
  }
} // namespace vibrocontact
