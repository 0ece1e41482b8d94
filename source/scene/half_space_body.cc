#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/scene/half_space_body.h>

#include <cmath>

namespace vibrocontact
{
  void HalfSpaceParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    const dealii::Patterns::Double radius(-1e4, 1e4);
    prm.add_parameter(
        "Radius x", radius_x,
        "Radius of curvature in the plane of the rolling line, positive for a convex body, 0 for a "
        "flat surface. Units: m.",
        radius);
    prm.add_parameter("Radius y", radius_y,
                      "Radius of curvature in the lateral plane, positive for a convex body, 0 for a flat "
                      "surface. Units: m.",
                      radius);
  }

  void HalfSpaceParameters::check(const std::string &section) const
  {
    for (const auto &[entry, radius] : {std::make_pair("Radius x", radius_x), {"Radius y", radius_y}})
      if (radius != 0 && std::abs(radius) < 1e-4)
        throw InputError(section + "/" + entry + " is " + std::to_string(radius) +
                         " m, too sharp for a half-space; give it in m, or 0 for a flat surface");
  }
} // namespace vibrocontact
