#pragma once

#include <vibrocontact/scene/material.h>

#include <deal.II/base/parameter_handler.h>

namespace vibrocontact
{
  /// `subsection Rolling/Axle`: a straight axle of round section from the hub of body 1 to that of a second wheel, which is body 1
  /// turned round, and the boxes at which the suspension carries both.
  ///
  ///      box   hub of body 1              hub of the second wheel   box
  ///       o------[]==============================[]------o        --> -y
  ///       distance          length                 distance
  struct AxleParameters
  {
    /// between the hubs' centres; of the section, the inner one of a hollow axle; of the boxes beyond the hubs [m]
    double length = 0, radius = 0, inner_radius = 0, box_distance = 0;
    /// of each box [kg]
    double box_mass = 0;
    ElasticMaterial material;
    /// of its fixed-interface modes that are kept [Hz]
    double upper_frequency = 10000;

    double area() const;
    /// second moment of area about a diameter [m^4]
    double moment() const;
    /// Cowper's, of a solid or hollow circle (J. Appl. Mech. 33, 1966) [-]
    double shear_coefficient() const;

    void declare_parameters(dealii::ParameterHandler &prm);
    /// Whether any of it is set: Length or Radius.
    bool any() const { return length > 0 || radius > 0; }
    /// @throws InputError
    void check() const;
  };
} // namespace vibrocontact
