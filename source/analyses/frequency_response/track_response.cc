#include <vibrocontact/analyses/frequency_response/track_response.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/shared_cases.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// spans over which decay is summed, as the last place of EN 15461
    constexpr unsigned int most_spans = 66;
    /// waves that decay by more in a span are near fields
    constexpr double least_factor = 0.01;

    std::vector<TrackPlace> track_places(const FrequencyResponseParameters &parameters)
    {
      std::vector<TrackPlace> places;
      for (const ResponsePoint &point : parameters.parsed_points())
      {
        // components of a point: z, x, y
        const unsigned int directions[3] = {2, 0, 1};
        places.push_back({point.x, point.y, point.z, directions[point.component]});
      }
      return places;
    }
  } // namespace

  void check_track_points(const BodyParameters &body, const RailParameters &rail,
                          const FrequencyResponseParameters &parameters)
  {
    check_track_places(body, rail, track_places(parameters), parameters.load_length, parameters.load_width);
  }

  TrackResponse::TrackResponse(const BodyParameters &body, const RailParameters &rail,
                               const FrequencyResponseParameters &parameters)
      : parameters(parameters), rail(body, rail, track_places(parameters), parameters.load_length,
                                     parameters.load_width, parameters.frequencies().back())
  {
  }

  std::vector<double> TrackResponse::solve(const double frequency) const
  {
    const unsigned int n = rail.loads.size();
    const double omega = 2 * dealii::numbers::PI * frequency;
    std::vector<double> outcome;
    const auto add = [&](const std::complex<double> &number)
    {
      outcome.push_back(number.real());
      outcome.push_back(number.imag());
    };
    const PeriodicTrack::AtFrequency at = rail.track.at(omega);
    const ComplexMatrix H = rail.track.receptance(at, rail.loads);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        add(H(i, j));
    for (const auto &responses : rail.track.along(at, {rail.exciters[1], rail.exciters[0]},
                                                  {rail.observers[1], rail.observers[0]}, most_spans))
    {
      outcome.push_back(responses.size());
      for (const std::complex<double> &one : responses)
        outcome.push_back(std::norm(one));
    }
    if (!is_irregular() && !parameters.pass_bands)
      return outcome;
    const PeriodicTrack regular = rail.track.regular();
    const PeriodicTrack::AtFrequency at_regular = is_irregular() ? regular.at(omega) : at;
    if (is_irregular())
    {
      const ComplexMatrix G = regular.receptance(at_regular, rail.loads);
      for (unsigned int i = 0; i < n; ++i)
        add(G(i, i));
    }
    if (parameters.pass_bands)
      for (const auto &all : regular.span_factors(at_regular))
      {
        const unsigned int kept =
            std::count_if(all.begin(), all.end(),
                          [](const std::complex<double> &factor) { return std::abs(factor) > least_factor; });
        outcome.push_back(kept);
        for (unsigned int k = 0; k < kept; ++k)
          add(all[k]);
      }
    return outcome;
  }

  ResponseVariant TrackResponse::direct(const std::vector<double> &frequency)
  {
    ResponseVariant result = {"direct", 0, frequency, {}};
    const unsigned int n = rail.loads.size();
    Progress progress("frequencies of the track", frequency.size());
    share_cases<std::vector<double>>(
        frequency.size(), 1,
        [&]
        {
          return std::function<std::vector<double>(unsigned int)>([&](const unsigned int k)
                                                                  { return solve(frequency[k]); });
        },
        [&](const unsigned int k, const std::function<std::vector<double>()> &outcome)
        {
          const std::vector<double> numbers = outcome();
          auto next = numbers.begin();
          const auto complex = [&]
          {
            const double real = *next++;
            return std::complex<double>(real, *next++);
          };
          Receptance H(n * n);
          for (std::complex<double> &entry : H)
            entry = complex();
          result.response.push_back(H);
          for (std::vector<double> &along : squares[frequency[k]])
          {
            const unsigned int count = *next++;
            along.assign(next, next + count);
            next += count;
          }
          if (is_irregular())
          {
            auto &points = beside[frequency[k]];
            for (unsigned int i = 0; i < n; ++i)
              points.push_back({{H[i * (n + 1)], complex()}});
          }
          while (next != numbers.end())
          {
            auto &waves = factors[frequency[k]].emplace_back();
            const unsigned int count = *next++;
            while (waves.size() < count)
              waves.push_back(complex());
          }
          progress.advance();
        },
        MPI_COMM_WORLD);
    return result;
  }

  Table TrackResponse::decay_rates(const std::string &body) const
  {
    const std::size_t n_places = squares.empty() ? 0 : squares.begin()->second[0].size();
    Table table(
        {"frequency_Hz", "vertical_dB_m", "lateral_dB_m", "vertical_on_grid_dB_m", "lateral_on_grid_dB_m"},
        {"Decay rates of " + body +
             " along the track after EN 15461, from the contact on, places at quarters of "
             "a span, " +
             (n_places > 4 * most_spans
                  ? std::to_string(most_spans) + " spans"
                  : "the " + std::to_string(n_places) +
                        " of them up to the end of its supports: what goes on beyond is not in the sums"),
         "on_grid: at 29 of these places, by quarters to 2 spans, halves to 4, whole ones to 8, then 10, "
         "12, 14, 16, 20, 24, 30, 36, 42, 48, 54, 66"});
    const double spacing = rail.track.spacing;
    for (const auto &[frequency, along] : squares)
      table.add_row({frequency, decay_rate_at_quarters(along[0], spacing),
                     decay_rate_at_quarters(along[1], spacing), decay_rate_on_grid(along[0], spacing),
                     decay_rate_on_grid(along[1], spacing)});
    return table;
  }

  Table TrackResponse::decay_rate_bands(const std::string &body) const
  {
    Table table(
        {"band_Hz", "frequencies", "vertical_dB_m", "lateral_dB_m"},
        {"Decay rates of " + body + " by third-octave bands after EN 15461, on the grid of the standard",
         "frequencies: that were solved in the band, between which squares go along straight lines"});
    for (const BandDecayRates &band : band_decay_rates(squares, rail.track.spacing))
      table.add_row({band.nominal, double(band.n_frequencies), band.rates[0], band.rates[1]});
    return table;
  }

  Table TrackResponse::beside_regular(const std::string &body) const
  {
    std::vector<std::string> columns = {"frequency_Hz"};
    for (const ResponsePoint &point : parameters.parsed_points())
      for (const char *track : {"", "_regular"})
        columns.push_back(point.name + "_" + "zxy"[point.component] + track + parameters.unit_ending());
    Table table(columns, {"Magnitude of the " + parameters.quantity + " of " + body +
                          " at its points, beside that on equal supports without end (regular)"});
    for (const auto &[frequency, points] : beside)
    {
      std::vector<Table::Cell> row = {frequency};
      for (const auto &both : points)
        for (const std::complex<double> &one : both)
          row.push_back(std::abs(parameters.shown(one, frequency)));
      table.add_row(row);
    }
    return table;
  }

  Table TrackResponse::pass_bands(const std::string &body) const
  {
    const double spacing = rail.track.spacing;
    Table table(
        {"frequency_Hz", "rails", "wave", "phase_rad", "wavenumber_rad_m", "decay_dB_m"},
        {"Waves of " + body +
             " from span to span of equal supports, least decaying ones first, at most 40 dB in a span",
         "phase: of a span, from -pi to pi, of motion e^{i w t} to the right; wavenumber: without its sign, "
         "up to pi / spacing; rails: of sleepers that are beams, how both rails move"});
    for (const auto &[frequency, motions] : factors)
      for (unsigned int m = 0; m < motions.size(); ++m)
        for (unsigned int k = 0; k < motions[m].size(); ++k)
        {
          const double phase = -std::arg(motions[m][k]);
          const bool pair = rail.track.support.sleeper.any() && rail.track.support.sleeper.beam;
          table.add_row({frequency,
                         std::string(!pair                                        ? "one"
                                     : rail.track.pairs[m] == RailPair::symmetric ? "symmetric"
                                                                                  : "antisymmetric"),
                         double(k), phase, std::abs(phase) / spacing,
                         -20 * std::log10(std::abs(motions[m][k])) / spacing});
        }
    return table;
  }

  Table TrackResponse::free_waves(const std::string &body) const
  {
    Table table({"wavenumber_rad_m", "frequency_Hz", "group_velocity_m_s"},
                {"Free waves of the section of " + body + ", without supports and losses"});
    const double highest = parameters.frequencies().back(), step = 0.25;
    // the slowest wave leaves the band at last; 2,000 rad/m is beyond what the section's elements resolve
    for (double k = 0; k <= 2000; k += step)
    {
      const std::vector<FreeWave> waves = vibrocontact::free_waves(rail.track.section.matrices, k, highest);
      if (waves.empty())
        break;
      for (const FreeWave &wave : waves)
        table.add_row({k, wave.frequency, wave.group_velocity});
    }
    return table;
  }
} // namespace vibrocontact
