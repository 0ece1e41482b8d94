#pragma once

#include <vibrocontact/waveguide/sleeper.h>
#include <vibrocontact/waveguide/slice.h>

#include <array>
#include <complex>
#include <optional>
#include <vector>

namespace vibrocontact
{
  /// What carries a rail: a pad, spread over a length and the width of the foot, and below it ground that stands still, or a
  /// sleeper on ballast.
  ///
  ///      ======================== rail
  ///          [####]  pad
  ///          |    |  sleeper
  ///           /\/    ballast
  struct TrackSupport
  {
    /// of one pad in x, y, z [N/m]; over its length [m]
    std::array<double, 3> pad_stiffness = {{36e6, 36e6, 180e6}};
    double pad_loss = 1, pad_length = 0.15;
    Sleeper sleeper;
  };

  /// A section on its foot, in some shapes.
  struct TrackSection
  {
    SectionMatrices matrices;
    /// what springs of 1 N/m^3 under the foot add to K0, in x, y, z [m]
    std::array<DenseMatrix, 3> foot_springs;
    /// what 1 N/m^2 on the foot does per length, in x, y, z
    std::array<DenseVector, 3> foot_loads;
    /// what a vertical pressure that grows by 1 N/m^3 along y from the foot's middle does per length
    DenseVector foot_lever;
    double foot_width = 0; ///< [m]
  };

  /// A slab below the pads, under one rail: a Timoshenko beam along the track on an elastic bed, with hysteretic losses,
  ///
  ///   ======================== rail
  ///       []      []      []   pads
  ///   ------------------------ slab
  ///    /\/\/\/\/\/\/\/\/\/\/\/  bed
  ///
  /// It moves vertically alone; pads along x and y hold the rail against ground that stands still.
  struct TrackSlab
  {
    double mass = 1150;               ///< per length [kg/m]
    double bending_stiffness = 120e6; ///< E I [N m^2]
    double shear_stiffness = 5e9;     ///< kappa G A [N]
    double gyration_radius = 0.087;   ///< of its section [m]
    double loss_factor = 0.02;
    double bed_stiffness = 150e6; ///< per length [N/m^2]
    double bed_loss = 0.1;
  };

  /// A rail's section and two more shapes, deflection and slope of the slab, on which its pads stand.
  TrackSection with_slab(const TrackSection &rail, const TrackSlab &slab);

  /// A load on the rail among these shapes.
  DenseVector with_slab_at_rest(const DenseVector &load);

  TrackSection track_section(const SectionElements &elements, const SectionShapes &shapes);

  /// The part of a rail about one support.
  struct TrackSpan
  {
    /// place of the support, begin and end of the part [m]
    double support = 0, begin = 0, end = 0;
    /// by which the pad is stiffer than others
    double pad_factor = 1;
  };

  /// How a span is divided and solved.
  struct SpanElements
  {
    /// longest element along the rail [m], its polynomial degree
    double length = 0.04;
    unsigned int degree = 4;
  };

  /// Free rail, rail on its pad, free rail: the same for all motions of the seat below the pad.
  struct SpanPieces
  {
    /// empty where the pad reaches to the end of the span
    std::optional<Slice> before, behind;
    /// on a seat that is held; behind the loads forces between seat and foot, one for each motion of the seat
    Slice on_pad;
    /// of the pad against motions of a seat [N/m], roll [N m]
    std::vector<std::complex<double>> pad_stiffness;
  };
  /// Loads that are not in the span do nothing. @param n_seat_motions 0: rigid ground
  SpanPieces span_pieces(const TrackSection &section, const TrackSupport &support,
                         unsigned int n_seat_motions, const TrackSpan &span, const SpanElements &elements,
                         std::complex<double> omega, const std::vector<AxialLoad> &loads);
  /// The whole span. @param seat receptance of the sleeper below the pad (sleeper.h); empty: rigid ground
  Slice on_seat(const SpanPieces &pieces, const ComplexMatrix &seat);
  Slice span_slice(const TrackSection &section, const TrackSupport &support, const ComplexMatrix &seat,
                   const TrackSpan &span, const SpanElements &elements, std::complex<double> omega,
                   const std::vector<AxialLoad> &loads);
} // namespace vibrocontact
