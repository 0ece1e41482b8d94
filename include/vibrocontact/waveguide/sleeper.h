#pragma once

#include <vibrocontact/waveguide/slice.h>

#include <array>
#include <complex>
#include <optional>

namespace vibrocontact
{
  /// How the two rails of a track move: both alike (a mirror image about the middle of the track), or against each other.
  enum class RailPair
  {
    symmetric,
    antisymmetric
  };

  /// A sleeper across the track as a uniform Timoshenko beam on ballast, which bends in the vertical plane,
  ///
  ///   kappa G A (w' - t)' - (k_b - w^2 rho A) w = -f,    E I t'' + kappa G A (w' - t) + w^2 rho A r^2 t = -m,
  ///
  /// with hysteretic losses: w down to the ballast, t its slope; k_b and rho A are twice ballast and mass of one rail's half sleeper over the
  /// length. Along itself it is rigid. It does not twist, and turns about the vertical as a whole.
  ///
  ///      v rail            v rail
  ///   ===========================      length
  ///    /\/\/\/\/\/\/\/\/\/\/\/\/       ballast
  ///      |---rail_distance---|
  struct SleeperBeam
  {
    /// without: it shifts and rolls as a rigid body, E I and kappa G A are not read
    bool bends = true;
    double length = 2.6, rail_distance = 1.5; ///< [m]
    double bending_stiffness = 6e6;           ///< E I [N m^2]
    double shear_stiffness = 4e8;             ///< kappa G A [N]
    double gyration_radius = 0.06;            ///< r of its section [m]
    double loss_factor = 0.02;
  };

  /// A sleeper under one of two rails, and its ballast.
  struct Sleeper
  {
    /// under one rail [kg]; 0: none, pads lie on rigid ground
    double mass = 0;
    /// of the ballast under one rail's part in x, y, z [N/m]
    std::array<double, 3> ballast_stiffness = {{0, 0, 0}};
    double ballast_loss = 0;
    /// empty: a mass that shifts along x, y and z, the other rail is not seen
    std::optional<SleeperBeam> beam;

    bool any() const { return mass > 0; }
    /// motions of a seat: x, y, z [m], and of a beam the roll about x [rad]; none on rigid ground
    unsigned int n_motions() const { return !any() ? 0 : beam ? 4 : 3; }
  };

  /// Motions of a rail's seat under forces and a moment on it, with the same (mirrored) ones on the other seat; square
  /// [m/N, 1/N, 1/(N m)]. The middle of the track lies at y < 0 of this rail.
  ComplexMatrix seat_receptance(const Sleeper &sleeper, std::complex<double> omega, RailPair pair);
} // namespace vibrocontact
