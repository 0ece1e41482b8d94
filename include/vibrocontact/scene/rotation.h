#pragma once

#include <vibrocontact/scene/elastic_model.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// `subsection Rotation` of a body that may turn steadily about an axis: a blade, a part of a rotor. It is seen in axes
  /// that turn with it, and so is what it touches.
  struct RotationParameters
  {
    /// Omega, right-handed about the axis; 0: it does not turn [rad/s]
    double speed = 0;
    /// direction of the axis, of any length; a point of it [m], both in the axes of the contact
    std::vector<double> axis = {0, 0, 1}, point = {0, 0, 0};
    /// whether Coriolis forces are taken
    bool coriolis = true;

    bool turns() const { return speed != 0; }
    bool has_coriolis() const { return turns() && coriolis; }
    void declare_parameters(dealii::ParameterHandler &prm);
    /// @throws InputError; `section` is named in it
    void check(const std::string &section) const;
    SteadyRotation<3> steady() const;
    /// Whether both turn in the same way, about the same axis.
    bool is_same_as(const RotationParameters &other) const;
  };
} // namespace vibrocontact
