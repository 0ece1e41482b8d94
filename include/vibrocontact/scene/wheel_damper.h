#pragma once

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace vibrocontact
{
  /// `subsection Damper` of a wheel by harmonics, a subsection of each name in its entry Dampers: what takes energy from the
  /// wheel besides its own materials. No part of the reduction, so that variants cost no finite-element step
  /// (reduction/damped_wheel.h, doc/wheel_damping.md).
  ///
  ///   absorber   equal masses on springs k (1 + j eta) at one place of the section, evenly around the axle
  ///   ring       the limit of many: mass and spring spread evenly around the axle
  ///   layer      loss factor added to all elements between two radii
  struct WheelDamper
  {
    std::string name;
    std::string kind = "absorber";
    /// of each absorber, of the whole ring [kg]
    double mass = 0;
    /// of the mass on its spring with the wheel held, 0: fixed to the wheel [Hz]
    double frequency = 0;
    /// eta of the spring or of the layer [-]
    double loss_factor = 0;
    /// where on the section's boundary, axial position and radius as in its outline [m]
    double axial = 0, radius = 0;
    /// along which the mass moves on its spring; it rides with the wheel along the others
    std::string direction = "axial";
    /// of absorbers; angle of the first from the contact point, towards where the wheel rolls from [degrees]
    unsigned int number = 1;
    double first_angle = 0;
    /// of a layer [m]
    double inner_radius = 0, outer_radius = 1e3;

    bool is_layer() const { return kind == "layer"; }
    bool is_ring() const { return kind == "ring"; }
    void declare_parameters(dealii::ParameterHandler &prm);
    /// @throws InputError; `section` is named in it
    void check(const std::string &section) const;
    /// Names of the entries that this kind reads.
    std::string entries() const;
  };
} // namespace vibrocontact
