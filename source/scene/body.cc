#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/named_table.h>
#include <vibrocontact/scene/bar.h>
#include <vibrocontact/scene/beam_rail.h>
#include <vibrocontact/scene/blade.h>
#include <vibrocontact/scene/block.h>
#include <vibrocontact/scene/body.h>
#include <vibrocontact/scene/half_space_body.h>
#include <vibrocontact/scene/identified.h>
#include <vibrocontact/scene/layer.h>
#include <vibrocontact/scene/matrices.h>
#include <vibrocontact/scene/mesh_file.h>
#include <vibrocontact/scene/oscillator.h>
#include <vibrocontact/scene/rail.h>
#include <vibrocontact/scene/ring.h>
#include <vibrocontact/scene/wheel.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    template <class Description>
    std::shared_ptr<BodyDescription> make()
    {
      return std::make_shared<Description>();
    }
  } // namespace

  const BodyTypes &body_types()
  {
    static const BodyTypes types = {
        {"half-space", "Half-space", "elastic half-space of Hertzian radii, no mesh",
         make<HalfSpaceParameters>},
        {"rigid", "Rigid", "rigid plane or paraboloid: stop, road", make<RigidParameters>},
        {"wheel", "Wheel", "section revolved about an axle, bore held", make<WheelParameters>},
        {"rail", "Rail", "section extruded along x on pads", make<RailParameters>},
        {"beam rail", "Beam rail", "rail as a Timoshenko beam on pads, half-space under the contact",
         make<BeamRailParameters>},
        {"block", "Block", "box of hexahedra", make<BlockParameters>},
        {"blade", "Blade", "twisted cantilever of hexahedra, root held", make<BladeParameters>},
        {"layer", "Layer", "elastic layer on a rigid plane: plane strain or a box, held on top",
         make<LayerParameters>},
        {"bar", "Bar", "straight bar along z that only stretches", make<BarParameters>},
        {"identified", "Identified",
         "known by measured or computed Green's functions, see section Identification",
         make<IdentifiedParameters>},
        {"ring", "Ring", "tyre: ring on an elastic foundation, analytic or of elements",
         make<RingParameters>},
        {"oscillator", "Oscillator", "mass on a spring and a damper under its weight",
         make<OscillatorParameters>},
        {"matrices", "Matrices", "by mass and stiffness matrices of another program, whole or reduced",
         make<MatricesParameters>},
        {"mesh", "Mesh", "hexahedra, tetrahedra or prisms with named groups from a mesh file",
         make<MeshFileParameters>},
    };
    return types;
  }

  nlohmann::ordered_json BodyDescription::sizes() const
  {
    return nlohmann::ordered_json::object();
  }

  BodyParameters::BodyParameters(const std::string &name, const std::string &type,
                                 const std::shared_ptr<const BodyTypes> &types)
      : name(name), type(type), types(types)
  {
    description = body_type().make();
  }

  const BodyType &BodyParameters::body_type() const
  {
    const auto found = std::find_if(types->begin(), types->end(),
                                    [&](const BodyType &candidate) { return candidate.name == type; });
    AssertThrow(found != types->end(), dealii::ExcMessage("unknown type of body " + type));
    return *found;
  }

  void BodyParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    std::string help;
    for (const auto &candidate : *types)
      help += (help.empty() ? "" : "; ") + candidate.name + ": " + candidate.help;
    prm.add_parameter("Type", type, "Kind of body. " + help + ". Units: none.",
                      dealii::Patterns::Selection(selection(names_of(*types))));
    const auto declare = [&](const std::string &section, auto &group)
    {
      prm.enter_subsection(section);
      group.declare_parameters(prm);
      prm.leave_subsection();
    };
    if (description->has_groups())
    {
      materials_entry.clear();
      for (const auto &group : materials)
        materials_entry += (materials_entry.empty() ? "" : ", ") + group.first;
      prm.add_parameter("Materials", materials_entry,
                        "Physical groups of the mesh's cells that have a material each, separated by commas: "
                        "steel, rubber. Section Material then holds a subsection of each name with its "
                        "entries. Empty: one material for the whole body. Units: none.",
                        dealii::Patterns::Anything());
    }
    const auto declare_material = [&](const std::string &section, ElasticMaterial &group)
    {
      prm.enter_subsection(section);
      group.declare_parameters(prm);
      if (may_be_orthotropic())
        declare("Orthotropic", group.orthotropic);
      prm.leave_subsection();
    };
    if (description->has_material() && materials.empty())
      declare_material("Material", material);
    if (!materials.empty())
    {
      prm.enter_subsection("Material");
      for (auto &[group, own] : materials)
        declare_material(group, own);
      prm.leave_subsection();
    }
    declare(body_type().section, *description);
    if (description->may_turn())
      declare("Rotation", rotation);
    if (is_solid())
      declare("Loads", loads);
    if (description->takes_gravity())
    {
      prm.enter_subsection("Loads");
      loads.declare_gravity(prm);
      prm.leave_subsection();
    }
  }

  void BodyParameters::check(const std::string &section) const
  {
    for (const auto &[group, own] : materials)
      own.check(section + "/Material/" + group);
    if (description->has_material() && materials.empty())
      material.check(section + "/Material");
    check_isotropic(section);
    description->check(section + "/" + body_type().section);
    if (is_solid())
      loads.check(section + "/Loads");
    if (description->may_turn())
      check_rotation(section + "/Rotation");
    if (!is_prestressed())
      return;
    if (const std::string reason = description->in_the_way_of_prestress(name); !reason.empty())
      throw InputError(reason + (rotation.turns() ? " of its Rotation." : " (Loads/Prestress)."));
    const auto [empty, advice] = description->missing_support(name);
    if (!empty.empty())
      throw InputError(
          (rotation.turns() ? section + "/Rotation/Speed is not 0" : section + "/Loads/Prestress is true") +
          ", but " + empty + ", so that nothing holds the body against its loads; " + advice + ".");
  }

  bool BodyParameters::may_be_orthotropic() const
  {
    return is_solid() && description->has_material();
  }

  bool BodyParameters::is_orthotropic() const
  {
    return material.is_orthotropic() ||
           std::any_of(materials.begin(), materials.end(),
                       [](const auto &group) { return group.second.is_orthotropic(); });
  }

  void BodyParameters::check_isotropic(const std::string &section) const
  {
    if (is_orthotropic() && description->is_wheel())
      throw InputError(
          section + "/Material has constants of an orthotropic material, but " + name +
          " is a wheel, whose modes are named by their waves around the axle, which need a material "
          "that is the same all around: leave Orthotropic out.");
  }

  void BodyParameters::check_rotation(const std::string &section) const
  {
    rotation.check(section);
    if (!rotation.turns())
      return;
    if (description->is_wheel())
      throw InputError(section + "/Speed is given, but " + name +
                       " is a wheel, whose contact does not turn with it: leave it out; a wheel of Model = "
                       "harmonics turns by Wheel/Rotation.");
    const SteadyRotation<3> steady = rotation.steady();
    if (loads.gravity != 0 && std::abs(steady.axis[2]) < 1 - 1e-12)
      throw InputError(section +
                       "/Axis is not along z, but there is a Gravity, whose direction changes all the time "
                       "for a body that turns: set Loads/Gravity to 0 or turn about z.");
  }

  double BodyParameters::material_loss_factor() const
  {
    double loss = description->has_material() && materials.empty() ? material.loss_factor : 0;
    for (const auto &group : materials)
      loss = std::max(loss, group.second.loss_factor);
    return loss;
  }

  std::optional<double> BodyParameters::axle_height(const double lateral_position) const
  {
    if (!description->is_wheel())
      return {};
    return tread_radius(*description->wheel_section(), lateral_position);
  }

  std::optional<std::pair<double, double>> BodyParameters::contact_limits() const
  {
    if (!description->is_wheel())
      return {};
    return tread_limits(*description->wheel_section());
  }
} // namespace vibrocontact
