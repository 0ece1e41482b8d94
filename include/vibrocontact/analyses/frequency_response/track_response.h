#pragma once

#include <vibrocontact/analyses/frequency_response/frequency_response_output.h>
#include <vibrocontact/waveguide/rail_track.h>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// @throws InputError for points that are not on the rail
  void check_track_points(const BodyParameters &body, const RailParameters &rail,
                          const FrequencyResponseParameters &parameters);

  /// The frequency response of a periodic rail: receptances of its points, decay rates along the track, free waves of its
  /// section.
  class TrackResponse
  {
  public:
    /// @throws InputError for points that are not on the rail
    TrackResponse(const BodyParameters &body, const RailParameters &rail,
                  const FrequencyResponseParameters &parameters);

    /// Shared over the ranks. Collective. @throws ConvergenceError if nothing takes energy
    ResponseVariant direct(const std::vector<double> &frequency);

    /// Of the frequencies solved so far: vertical and lateral, EN 15461 (see track_decay_rate()), quarter spans up to 66.
    Table decay_rates(const std::string &body) const;

    /// Frequency and group velocity over wavenumber of the rail without supports and losses, up to the highest frequency.
    Table free_waves(const std::string &body) const;

    const RailTrack &rail_track() const { return rail; }

  private:
    const FrequencyResponseParameters &parameters;
    const RailTrack rail;
    /// by frequency [Hz]: lateral, vertical [dB/m]
    std::map<double, std::array<double, 2>> decay;
  };
} // namespace vibrocontact
