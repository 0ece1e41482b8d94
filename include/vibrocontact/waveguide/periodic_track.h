#pragma once

#include <vibrocontact/waveguide/irregular_supports.h>
#include <vibrocontact/waveguide/track_span.h>

#include <array>
#include <complex>
#include <optional>
#include <utility>
#include <vector>

namespace vibrocontact
{
  /// What follows beyond a track's own supports.
  enum class TrackEnds
  {
    track, ///< equal supports without end
    free,  ///< nothing
    rail   ///< the rail alone, without end: no wave comes back from it
  };

  /// A rail on supports, in harmonic motion with hysteretic losses, exactly: each span is a slice, the track beyond the
  /// places that are loaded is joined or, where its supports are equal without end, doubled up to infinity (slice.h).
  ///
  ///        x = 0
  ///   ...====|====...     supports at first_support + j spacing, or own ones and then such as these
  ///       []   []
  ///
  /// Of two rails on sleepers that are beams, one is loaded: its motion is the mean of a symmetric and an antisymmetric one.
  struct PeriodicTrack
  {
    TrackSection section;
    TrackSupport support;
    /// below the pads in place of sleepers
    std::optional<TrackSlab> slab;
    double spacing = 0.6, first_support = 0.3;
    /// longest element along the rail [m], its polynomial degree
    double element_length = 0.04;
    unsigned int degree = 4;
    /// from left to right; empty: equal ones without end
    std::vector<OwnSupport> own;
    TrackEnds beyond = TrackEnds::track;
    /// how both rails move on sleepers that are beams
    std::vector<RailPair> pairs = {RailPair::symmetric, RailPair::antisymmetric};
    /// shapes of the section in which spans far from loads move, and all spans where they meet them; empty: all shapes
    std::vector<unsigned int> far_shapes;

    /// Unloaded spans and what follows at their ends, for one motion of both rails.
    struct RailMotion
    {
      /// empty: rigid ground
      ComplexMatrix seat;
      /// a span of equal supports, and those of the own ones
      Slice span;
      std::vector<Slice> own_spans;
      /// dynamic stiffness of what follows to the left and right of the borders of own spans, from left to right; one border
      /// if there are no own supports. Empty matrix: nothing
      std::vector<ComplexMatrix> left, right;
    };

    /// At one frequency; complex: omega = -i s of motion e^{st}, Re s >= 0.
    struct AtFrequency
    {
      std::complex<double> omega = 0; ///< [rad/s]
      /// the track's motion is the mean of these
      std::vector<RailMotion> motions;
    };
    /// @throws ConvergenceError if nothing takes energy
    AtFrequency at(std::complex<double> omega) const;

    /// Motions at loads anywhere under each of them [m/N].
    ComplexMatrix receptance(const AtFrequency &at, const std::vector<AxialLoad> &loads) const;

    /// Motions along the track under loads at x0 = centre, mid-span or over a support: at x0 the load's own mean, then those
    /// of a section at x0 + j spacing / 4, j = 1, 2, ..., n_spans further on, or as far as the rail goes [m/N]; by load.
    /// @param rows of the section, forces of the shapes for 1 N
    std::vector<std::vector<std::complex<double>>> along(const AtFrequency &at,
                                                         const std::vector<AxialLoad> &loads,
                                                         const std::vector<DenseVector> &rows,
                                                         unsigned int n_spans) const;

    /// Bloch factors of a span of equal supports, of the waves that decay to the right: motion goes by them from span to span.
    /// By motion of both rails, least decaying ones first.
    std::vector<std::vector<std::complex<double>>> span_factors(const AtFrequency &at) const;

    /// Where the rail begins and ends [m].
    std::pair<double, double> reach() const;
    /// The same track on equal supports without end.
    PeriodicTrack regular() const;

  private:
    /// the span of a number, own ones from 0 on
    TrackSpan span_of(int number) const;
    /// the span of a place, at a border the left one
    int number_at(double place) const;
    bool is_own(int number) const { return number >= 0 && number < int(own.size()); }
    ComplexMatrix seat(std::complex<double> omega, RailPair pair) const;
    /// with the slab: in all shapes or in those far from loads, and which ones these are
    TrackSection whole_section(bool far) const;
    std::vector<unsigned int> far_of_whole() const;
    AxialLoad on_whole(const AxialLoad &load) const;
    const Slice &unloaded(const RailMotion &motion, int number) const
    {
      return is_own(number) ? motion.own_spans[number] : motion.span;
    }
    /// what follows beyond the right end of a span, and beyond the left one of another
    const ComplexMatrix &right_of(const RailMotion &motion, int number) const;
    const ComplexMatrix &left_of(const RailMotion &motion, int number) const;
    /// how far from loads spans move in all shapes [m]
    double near_of_loads() const;
    /// the numbers of the first and the last span that is loaded, or near a load
    std::pair<int, int> loaded_spans(const std::vector<AxialLoad> &loads) const;
    /// A row of spans with loads, the same for all motions of the rails.
    struct LoadedPart
    {
      int first = 0, last = 0;
      unsigned int n_loads = 0;
      /// null of those far from loads between them
      std::vector<std::optional<SpanPieces>> pieces;
    };
    /// @param range first and last span
    LoadedPart loaded_part(std::complex<double> omega, const std::vector<AxialLoad> &loads,
                           const std::pair<int, int> &range) const;
    Slice in_motion(const LoadedPart &part, const RailMotion &motion) const;
  };
} // namespace vibrocontact
