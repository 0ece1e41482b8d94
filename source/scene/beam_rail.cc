#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/scene/beam_rail.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <sstream>

namespace vibrocontact
{
  void BeamRailParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter("Length", length, "Length of the rail; the contact is at its middle. Units: m.",
                      Double(0));
    prm.add_parameter("Lateral position", lateral_position,
                      "Position of the contact on the crown, from the symmetry plane. Units: m.", Double());
    RailSupports::declare_parameters(prm);
    prm.add_parameter("Area", area, "Area of the section. Units: m^2.", Double(1e-12, 10));
    prm.add_parameter("Moment of area y", moment_y,
                      "Second moment of area about the lateral axis, for vertical bending. Units: m^4.",
                      Double(1e-20, 10));
    prm.add_parameter("Moment of area z", moment_z,
                      "Second moment of area about the vertical axis, for lateral bending. Units: m^4.",
                      Double(1e-20, 10));
    prm.add_parameter("Torsion constant", torsion_constant, "Saint-Venant's torsion constant. Units: m^4.",
                      Double(1e-20, 10));
    prm.add_parameter("Warping constant", warping_constant,
                      "Warping constant about the shear centre; 0: the ends of a twisted piece warp freely. "
                      "Units: m^6.",
                      Double(0, 10));
    prm.add_parameter("Shear coefficient z", shear_coefficient_z,
                      "Share of the area that carries vertical shear. Units: none.", Double(1e-3, 10));
    prm.add_parameter("Shear coefficient y", shear_coefficient_y,
                      "Share of the area that carries lateral shear. Units: none.", Double(1e-3, 10));
    prm.add_parameter("Height", height, "Height of the crown above the underside. Units: m.",
                      Double(1e-6, 10));
    prm.add_parameter("Centroid height", centroid_height,
                      "Height of the centroid above the underside. Units: m.", Double(0, 10));
    prm.add_parameter("Shear centre height", shear_centre_height,
                      "Height of the shear centre above the underside. Units: m.", Double(-10, 10));
    prm.add_parameter("Foot width", foot_width,
                      "Width over which the pads are spread; 0: they hold the middle only. Units: m.",
                      Double(0, 10));
    prm.add_parameter("Crown radius", crown_radius, "Radius of the crown in the section; 0: flat. Units: m.",
                      Double(0));
    prm.add_parameter("Element length", element_length, "Longest element. Units: m.", Double(1e-4, 100));
    prm.add_parameter("Element degree", degree, "Polynomial degree of the elements. Units: none.",
                      Integer(2, 10));
  }

  void BeamRailParameters::check(const std::string &path) const
  {
    RailSupports::check(path);
    std::ostringstream text;
    const double lever = centroid_height - shear_centre_height;
    if (centroid_height >= height)
      text << path << "/Centroid height (" << centroid_height << " m) must be below Height (" << height
           << " m).";
    else if (crown_radius > 0 && std::abs(lateral_position) >= crown_radius)
      text << path << "/Lateral position (" << lateral_position << " m) must be smaller than Crown radius ("
           << crown_radius << " m).";
    else if (torsion_constant >= moment_y + moment_z + area * lever * lever)
      text << path << "/Torsion constant (" << torsion_constant
           << " m^4) must be smaller than the polar moment about the shear centre ("
           << moment_y + moment_z + area * lever * lever << " m^4).";
    else if (length / element_length * degree > 20000)
      text << path << "/Element length asks for more than 20,000 nodes: enlarge it.";
    if (!text.str().empty())
      throw InputError(text.str());
  }

  double BeamRailParameters::crown_height(const double y) const
  {
    return crown_radius > 0 ? height - crown_radius + std::sqrt(crown_radius * crown_radius - y * y) : height;
  }

  bool BeamRailParameters::add_entries(EntriesRead &entries, const std::string &section,
                                       const BodyUse &use) const
  {
    entries.add(section,
                "Length, Area, Moment of area y, Moment of area z, Torsion constant, Warping constant, "
                "Shear coefficient z, Shear coefficient y, Centroid height, Shear centre height, "
                "Element length, Element degree");
    entries.add_if(use.contact || use.points, "places on its crown are observed", section,
                   "Lateral position, Height");
    entries.add_if(use.contact || (use.points && lateral_position != 0),
                   "the body is in contact, or is observed beside its Lateral position 0", section,
                   "Crown radius");
    entries.add_if(has_pads(), "there are pads", section, "Foot width");
    add_support_entries(entries, section, use, true);
    return true;
  }

  void BeamRailParameters::print(Log &log) const
  {
    log.value("length", length, "m");
    log.value("supports", static_cast<unsigned int>(supports().size()));
  }

  nlohmann::ordered_json BeamRailParameters::sizes() const
  {
    return {{"length_m", length}, {"supports_m", supports()}};
  }

  std::pair<std::string, std::string> BeamRailParameters::missing_support(const std::string &name) const
  {
    return support_wanted(name + "/Beam rail");
  }
} // namespace vibrocontact
