#pragma once

#include <vibrocontact/scene/body.h>
#include <vibrocontact/scene/rail.h>
#include <vibrocontact/waveguide/periodic_track.h>
#include <vibrocontact/waveguide/section_basis.h>

#include <array>
#include <optional>
#include <vector>

namespace vibrocontact
{
  /// Where a periodic rail is excited and observed, in the coordinates of the contact (z from the crown).
  struct TrackPlace
  {
    double x = 0, y = 0; ///< [m]
    /// of a node next to it; without: a patch of the crown about (x, y)
    std::optional<double> z;
    unsigned int direction = 2; ///< 0 x, 1 y, 2 z
  };

  /// @throws InputError for places that are not on the rail, at less cost than the track
  void check_track_places(const BodyParameters &body, const RailParameters &rail,
                          const std::vector<TrackPlace> &places, double length, double width);

  /// A periodic track as the file describes it, and the loads at some places.
  class RailTrack
  {
  public:
    /// @param length, width of patches [m] @param up_to highest frequency [Hz]
    /// @throws InputError for places that are not on the rail
    RailTrack(const BodyParameters &body, const RailParameters &rail, const std::vector<TrackPlace> &places,
              double length, double width, double up_to);

    unsigned int n_section_dofs() const { return n_dofs; }

    PeriodicTrack track;
    std::vector<AxialLoad> loads;
    /// mean motion of the crown at the contact in y and z, for decay rates: a patch, and a section [1 N]
    std::array<AxialLoad, 2> exciters;
    std::array<DenseVector, 2> observers;

  private:
    unsigned int n_dofs = 0;
  };
} // namespace vibrocontact
