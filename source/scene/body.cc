#include <vibrocontact/scene/body.h>

#include <algorithm>

namespace vibrocontact
{
  const std::vector<BodyType> &body_types()
  {
    static const std::vector<BodyType> types = {
        {"half-space", "Half-space", "elastic half-space of Hertzian radii, no mesh", false},
        {"wheel", "Wheel", "section revolved about an axle, bore held", true},
        {"rail", "Rail", "section extruded along x on pads", true},
        {"block", "Block", "box of hexahedra", true},
        {"mesh", "Mesh", "hexahedra with named groups from a gmsh file", true},
    };
    return types;
  }

  const BodyType &BodyParameters::body_type() const
  {
    const auto found = std::find_if(body_types().begin(), body_types().end(),
                                    [&](const BodyType &candidate) { return candidate.name == type; });
    AssertThrow(found != body_types().end(), dealii::ExcMessage("unknown type of body " + type));
    return *found;
  }

  void BodyParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    std::string names, help;
    for (const auto &candidate : body_types())
    {
      names += (names.empty() ? "" : "|") + candidate.name;
      help += (help.empty() ? "" : "; ") + candidate.name + ": " + candidate.help;
    }
    prm.add_parameter("Type", type, "Kind of body. " + help + ". Units: none.",
                      dealii::Patterns::Selection(names));
    const auto declare = [&](const std::string &section, auto &group)
    {
      prm.enter_subsection(section);
      group.declare_parameters(prm);
      prm.leave_subsection();
    };
    declare("Material", material);
    if (type == "half-space")
      declare("Half-space", half_space);
    if (type == "block")
      declare("Block", block);
    if (type == "wheel")
      declare("Wheel", wheel);
    if (type == "rail")
      declare("Rail", rail);
    if (type == "mesh")
      declare("Mesh", mesh);
    if (is_meshed())
      declare("Loads", loads);
  }

  void BodyParameters::check(const std::string &section) const
  {
    material.check(section + "/Material");
    if (type == "half-space")
      half_space.check(section + "/Half-space");
    if (type == "block")
      block.check(section + "/Block");
    if (type == "wheel")
      wheel.check(section + "/Wheel");
    if (type == "rail")
      rail.check(section + "/Rail");
    if (type == "mesh")
      mesh.check(section + "/Mesh");
    if (is_meshed())
      loads.check(section + "/Loads");
  }

  std::optional<double> BodyParameters::axle_height(const double lateral_position) const
  {
    if (type == "wheel")
      return tread_radius(wheel.section.read_outline(wheel.scale), lateral_position);
    if (type == "mesh" && mesh.is_wheel())
      return tread_radius(wheel_outline(mesh), lateral_position);
    return {};
  }
} // namespace vibrocontact
