#include <vibrocontact/analyses/transient/signal_output.h>
#include <vibrocontact/analyses/transient/sound.h>
#include <vibrocontact/numerics/cycle_measure.h>
#include <vibrocontact/numerics/growth_fit.h>
#include <vibrocontact/numerics/spectrum.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vibrocontact
{
  namespace
  {
    bool varies(const Signal &signal)
    {
      if (signal.size() < 16)
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

    nlohmann::ordered_json cycle_json(const Signal &signal, const double frequency)
    {
      const CycleMeasure cycle = measure_cycle(signal, frequency);
      return {{"frequency_Hz", frequency}, {"amplitude", cycle.amplitude}, {"rms", cycle.rms},
              {"drift", cycle.drift},      {"spread", cycle.spread},       {"periods", cycle.n_periods}};
    }
  } // namespace

  nlohmann::ordered_json signals_json(const std::vector<NamedSignal> &signals,
                                      const SignalParameters &parameters, const double end_of_growth,
                                      const std::string &folder)
  {
    using Json = nlohmann::ordered_json;
    Json result = {{"dominant_frequencies_Hz", Json::array()}, {"signals", Json::array()}};
    for (const NamedSignal &one : signals)
    {
      const Signal &all = one.signal;
      const double duration = all.end() - all.begin;
      const Signal late = part(
          all, all.end() - (parameters.spectrum_duration > 0 ? parameters.spectrum_duration : duration / 2),
          all.end());
      const Signal early = part(all, parameters.growth_begin,
                                parameters.growth_end > 0 ? parameters.growth_end : end_of_growth);
      Json json = {{"name", one.name},
                   {"unit", one.unit},
                   {"spectrum_window_s", {late.begin, late.end()}},
                   {"peaks", Json::array()}};
      const double still = varies(late) ? constant_since(late) : late.end();
      if (late.end() - still > 0.25 * (late.end() - late.begin))
        json["constant_since_s"] = still; // an impact that is over, no oscillation
      else if (varies(late))
      {
        const auto peaks = spectral_peaks(late);
        for (const SpectralPeak &peak : peaks)
        {
          json["peaks"].push_back({{"frequency_Hz", peak.frequency}, {"amplitude", peak.amplitude}});
          if (&one == &signals.front())
            result["dominant_frequencies_Hz"].push_back(peak.frequency);
        }
        if (!peaks.empty())
          json["cycle"] = cycle_json(late, peaks.front().frequency);
        if (one.unit == "m/s")
        {
          json["level_dB"] = 20 * std::log10(rms(late) / velocity_reference);
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
      if (one.audible && parameters.sound && !folder.empty() && duration > least_sound && varies(all))
      {
        const std::string file = one.name + ".wav";
        json["sound"] = {{"file", file}, {"full_scale_m_s", write_sound(all, folder + "/" + file)}};
      }
      result["signals"].push_back(json);
    }
    return result;
  }
} // namespace vibrocontact
