#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/scene/half_space_body.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <sstream>

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
      if (radius != 0 && (std::abs(radius) < 1e-4 || std::abs(radius) > 100))
      {
        std::ostringstream text;
        text << section << "/" << entry << " is " << radius
             << " m, no radius of a contact; give it in m, or 0 for a flat surface";
        throw InputError(text.str());
      }
  }

  bool HalfSpaceParameters::add_entries(EntriesRead &entries, const std::string &section,
                                        const BodyUse &use) const
  {
    entries.add_if(use.contact && !use.in_a_point, "its surface is in contact, and not in a point alone",
                   section, "Radius x, Radius y");
    return true;
  }

  void HalfSpaceParameters::print(Log &log) const
  {
    log.value("radius along x", radius_x, "m (0: flat)");
    log.value("radius along y", radius_y, "m (0: flat)");
  }

  nlohmann::ordered_json HalfSpaceParameters::sizes() const
  {
    return {{"radius_x_m", radius_x}, {"radius_y_m", radius_y}};
  }
} // namespace vibrocontact
