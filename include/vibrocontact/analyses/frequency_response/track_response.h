#pragma once

#include <vibrocontact/analyses/frequency_response/frequency_response_output.h>
#include <vibrocontact/waveguide/decay_rate.h>
#include <vibrocontact/waveguide/rail_track.h>

#include <complex>
#include <map>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// @throws InputError for points that are not on the rail
  void check_track_points(const BodyParameters &body, const RailParameters &rail,
                          const FrequencyResponseParameters &parameters);

  /// The frequency response of a periodic rail: receptances of its points, decay rates along the track, free waves of its
  /// section, waves that pass from span to span.
  class TrackResponse
  {
  public:
    /// @throws InputError for points that are not on the rail
    TrackResponse(const BodyParameters &body, const RailParameters &rail,
                  const FrequencyResponseParameters &parameters);

    /// Shared over the ranks. Collective. @throws ConvergenceError if nothing takes energy
    ResponseVariant direct(const std::vector<double> &frequency);

    /// whether its supports are laid one by one
    bool is_irregular() const { return !rail.track.own.empty(); }

    // of the frequencies solved so far
    /// Vertical and lateral, EN 15461 (decay_rate.h), at all quarters of spans up to 66 and on the standard's grid.
    Table decay_rates(const std::string &body) const;
    /// The same by third-octave bands.
    Table decay_rate_bands(const std::string &body) const;
    /// Magnitude at the points under forces there, beside that of the same track on equal supports without end.
    Table beside_regular(const std::string &body) const;
    /// Phase and decay from span to span of the waves on equal supports, least decaying ones first.
    Table pass_bands(const std::string &body) const;

    /// Frequency and group velocity over wavenumber of the rail without supports and losses, up to the highest frequency.
    Table free_waves(const std::string &body) const;

    const RailTrack &rail_track() const { return rail; }

  private:
    /// numbers of one frequency, as ranks hand them over
    std::vector<double> solve(double frequency) const;

    const FrequencyResponseParameters &parameters;
    const RailTrack rail;
    DecayingResponses squares;
    /// by frequency [Hz]: receptances of the points on the track and on the regular one [m/N]; factors of its waves by motion of
    /// both rails
    std::map<double, std::vector<std::array<std::complex<double>, 2>>> beside;
    std::map<double, std::vector<std::vector<std::complex<double>>>> factors;
  };
} // namespace vibrocontact
