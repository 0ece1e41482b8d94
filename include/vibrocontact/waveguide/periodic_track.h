#pragma once

#include <vibrocontact/waveguide/slice.h>

#include <array>
#include <complex>
#include <utility>
#include <vector>

namespace vibrocontact
{
  /// What carries a rail at equal distances: a pad, spread over a length and the width of the foot, and below it ground that
  /// stands still, or a sleeper (a rigid mass that moves along x, y and z) on ballast.
  ///
  ///      ======================== rail
  ///          [####]  pad
  ///          |    |  mass of the sleeper under this rail
  ///           /\/    ballast
  struct TrackSupport
  {
    /// of one pad in x, y, z [N/m]; over its length [m]
    std::array<double, 3> pad_stiffness = {{36e6, 36e6, 180e6}};
    double pad_loss = 1, pad_length = 0.15;
    /// under one rail [kg]; 0: no sleeper, the pad lies on rigid ground
    double sleeper_mass = 0;
    /// of the ballast under one rail's part of a sleeper in x, y, z [N/m]
    std::array<double, 3> ballast_stiffness = {{0, 0, 0}};
    double ballast_loss = 0;
  };

  /// A section on its foot, in some shapes.
  struct TrackSection
  {
    SectionMatrices matrices;
    /// what springs of 1 N/m^3 under the foot add to K0, in x, y, z [m]
    std::array<DenseMatrix, 3> foot_springs;
    /// what 1 N/m^2 on the foot does per length, in x, y, z
    std::array<DenseVector, 3> foot_loads;
    double foot_width = 0; ///< [m]
  };

  TrackSection track_section(const SectionElements &elements, const SectionShapes &shapes);

  /// A rail on equal supports, infinite to both sides, in harmonic motion with hysteretic losses, exactly: each span is a
  /// slice, the track beyond the places that are loaded is doubled up to infinity (slice.h).
  ///
  ///        x = 0
  ///   ...====|====...     supports at first_support + j spacing
  ///       []   []
  struct PeriodicTrack
  {
    TrackSection section;
    TrackSupport support;
    double spacing = 0.6, first_support = 0.3;
    /// longest element along the rail [m], its polynomial degree
    double element_length = 0.04;
    unsigned int degree = 4;

    /// An unloaded span and what follows at its ends, at one frequency; complex: omega = -i s of motion e^{st}, Re s >= 0.
    struct AtFrequency
    {
      std::complex<double> omega = 0; ///< [rad/s]
      Slice span;
      InfiniteEnds ends;
    };
    /// @throws ConvergenceError if nothing takes energy
    AtFrequency at(std::complex<double> omega) const;

    /// Motions at loads anywhere under each of them [m/N].
    ComplexMatrix receptance(const AtFrequency &at, const std::vector<AxialLoad> &loads) const;

    /// Motions along the track under a load at x0 = load.centre, mid-span or over a support: at x0 the load's own mean, then
    /// those of a section at x0 + j spacing / 4, j = 1, 2, ... up to some spans further on [m/N].
    /// @param row of the section, force of the shapes for 1 N
    std::vector<std::complex<double>> along(const AtFrequency &at, const AxialLoad &load,
                                            const DenseVector &row, unsigned int n_spans) const;

    /// The span about a support at x, from half a spacing before it to half a spacing behind. Loads that are not in it do
    /// nothing.
    /// @param loss loss factor of the rail in place of its materials'; negative: theirs
    Slice span(std::complex<double> omega, double x, const std::vector<AxialLoad> &loads,
               double loss = -1) const;

  private:
    /// the numbers of the first and the last span that is loaded
    std::pair<int, int> loaded_spans(const std::vector<AxialLoad> &loads) const;
    Slice loaded_part(const AtFrequency &at, const std::vector<AxialLoad> &loads) const;
  };

  /// Decay rate of a track after EN 15461 [dB/m] from responses A_j at equal distances, the first at the exciter:
  ///
  ///   4.343 / sum_j |A_j|^2 / |A_0|^2 dx_j,   dx_0 = step / 2, dx_j = step.
  double track_decay_rate(const std::vector<std::complex<double>> &responses, double step);
} // namespace vibrocontact
