#pragma once

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace vibrocontact
{
  /// A mass on a spring and a damper above the road, pulled down by its weight (Meftah & Duhamel 2011, Eq. 51):
  ///
  ///   M u'' + C u' + K u = -M g + F_c,      C = 2 xi sqrt(K M),     u up, F_c >= 0 from the road
  ///
  /// Without contact it rests at u = -M g / K. One contact point. With friction its contact point also moves along
  /// the road, as a second oscillator: M_t v'' + C_t v' + K_t v = T, v and T forward.
  struct OscillatorParameters
  {
    /// M [kg], K [N/m], xi [-], g [m/s^2]
    double mass = 1, stiffness = 4e5, damping_ratio = 0.02, gravity = 9.81;
    /// the same along the road; with friction only
    double tangential_mass = 1, tangential_stiffness = 4e5, tangential_damping_ratio = 0.02;

    void declare_parameters(dealii::ParameterHandler &prm);
  };
} // namespace vibrocontact
