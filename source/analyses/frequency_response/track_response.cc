#include <vibrocontact/analyses/frequency_response/track_response.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/shared_cases.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include <algorithm>

namespace vibrocontact
{
  namespace
  {
    /// spans over which decay is summed, as the last place of EN 15461
    constexpr unsigned int most_spans = 66;

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
    check_track_places(body, rail, track_places(parameters), parameters.load_width);
  }

  TrackResponse::TrackResponse(const BodyParameters &body, const RailParameters &rail,
                               const FrequencyResponseParameters &parameters)
      : parameters(parameters), rail(body, rail, track_places(parameters), parameters.load_length,
                                     parameters.load_width, parameters.frequencies().back())
  {
  }

  ResponseVariant TrackResponse::direct(const std::vector<double> &frequency)
  {
    ResponseVariant result = {"direct", 0, frequency, {}};
    const unsigned int n = rail.loads.size();
    Progress progress("frequencies of the track", frequency.size());
    const auto solve = [&](const unsigned int k)
    {
      const PeriodicTrack::AtFrequency at = rail.track.at(2 * dealii::numbers::PI * frequency[k]);
      const ComplexMatrix H = rail.track.receptance(at, rail.loads);
      std::vector<double> outcome;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
        {
          outcome.push_back(H(i, j).real());
          outcome.push_back(H(i, j).imag());
        }
      for (const unsigned int d : {0, 1})
        outcome.push_back(track_decay_rate(
            rail.track.along(at, rail.exciters[d], rail.observers[d], most_spans), rail.track.spacing / 4));
      return outcome;
    };
    share_cases<std::vector<double>>(
        frequency.size(), 1, [&] { return std::function<std::vector<double>(unsigned int)>(solve); },
        [&](const unsigned int k, const std::function<std::vector<double>()> &outcome)
        {
          const std::vector<double> numbers = outcome();
          Receptance H(n * n);
          for (unsigned int i = 0; i < n * n; ++i)
            H[i] = {numbers[2 * i], numbers[2 * i + 1]};
          result.response.push_back(H);
          decay[frequency[k]] = {{numbers[2 * n * n], numbers[2 * n * n + 1]}};
          progress.advance();
        },
        MPI_COMM_WORLD);
    return result;
  }

  Table TrackResponse::decay_rates(const std::string &body) const
  {
    Table table({"frequency_Hz", "vertical_dB_m", "lateral_dB_m"},
                {"Decay rates of " + body +
                 " along the track after EN 15461, from the contact on, places at quarters of "
                 "a span, " +
                 std::to_string(most_spans) + " spans"});
    for (const auto &[frequency, rates] : decay)
      table.add_row({frequency, rates[1], rates[0]});
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
