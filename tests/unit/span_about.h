#pragma once

#include <vibrocontact/waveguide/periodic_track.h>

#include <complex>
#include <vector>

namespace vibrocontact
{
  /// The span about a support at x alone, from half a spacing before it to half a spacing behind. Of two rails the first motion.
  inline Slice span_about(const PeriodicTrack &track, const std::complex<double> omega, const double x,
                          const std::vector<AxialLoad> &loads)
  {
    const Sleeper &sleeper = track.support.sleeper;
    const ComplexMatrix seat =
        sleeper.any() ? seat_receptance(sleeper, omega, track.pairs.front()) : ComplexMatrix();
    return span_slice(track.section, track.support, seat,
                      {x, x - track.spacing / 2, x + track.spacing / 2, 1},
                      {track.element_length, track.degree}, omega, loads);
  }
} // namespace vibrocontact
