#pragma once

#include <vibrocontact/fe/trace_row.h>

#include <array>

namespace vibrocontact
{
  /// A place on a body of revolution where a force acts in one direction, or where its motion is looked at, developed in
  /// waves around the axle (fe/revolved_section.h). With e_r = (sin, -cos), e_t = (cos, sin) of theta in x and z, the motion
  /// of the place is the sum over n and both families of
  ///
  ///   x: u_r sin(theta) + u_t cos(theta)     y: u_a     z: u_t sin(theta) - u_r cos(theta)
  ///
  /// and a unit force there loads n waves of a family with the same weights: the energies are those of the whole body.
  struct RevolvedPoint
  {
    /// rows of the section there: axial, radial, circumferential
    std::array<TraceRow, 3> rows;
    /// around the axle from the contact, and half of the angle that the place is spread over [rad]
    double angle = 0, half_angle = 0;
    /// order of contact components: 0 z, 1 x, 2 y; in axes of the section: 0 axial, 1 radial, 2 circumferential
    unsigned int component = 0;
    bool in_section_axes = false;

    /// What axial, radial and circumferential amplitude of n waves of a family add to its motion; n = 0: even has the
    /// first two, odd the last one.
    std::array<double, 3> weights(unsigned int n, bool odd) const;
    /// whether its motion has axial, radial or circumferential amplitudes in it
    bool has(const unsigned int amplitude) const
    {
      return in_section_axes ? amplitude == component : (component == 2) == (amplitude == 0);
    }
  };

  /// What an axial (0), radial (1) or circumferential (2) amplitude of n waves adds to the motion along itself at an angle.
  double wave_weight(unsigned int n, bool odd, double angle, unsigned int amplitude);

  /// What axial, radial and circumferential amplitude of n waves add to the motion along a component of contact, mean
  /// over an angle to both sides. n = 0: of both families.
  std::array<double, 3> wave_weights(unsigned int n, bool odd, double angle, double half_angle,
                                     unsigned int component);
} // namespace vibrocontact
