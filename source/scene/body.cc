#include <vibrocontact/base/named_table.h>
#include <vibrocontact/scene/body.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  const BodyTypes &body_types()
  {
    static const BodyTypes types = {
        {"half-space", "Half-space", "elastic half-space of Hertzian radii, no mesh", false, false},
        {"rigid", "Rigid", "rigid plane or paraboloid: stop, road", false, false},
        {"wheel", "Wheel", "section revolved about an axle, bore held", true, true},
        {"rail", "Rail", "section extruded along x on pads", true, true},
        {"beam rail", "Beam rail", "rail as a Timoshenko beam on pads, half-space under the contact", true,
         false},
        {"block", "Block", "box of hexahedra", true, true},
        {"blade", "Blade", "twisted cantilever of hexahedra, root held", true, true},
        {"layer", "Layer", "elastic layer on a rigid plane: plane strain or a box, held on top", true, false},
        {"bar", "Bar", "straight bar along z that only stretches", true, false},
        {"identified", "Identified",
         "known by measured or computed Green's functions, see section Identification", false, false},
        {"ring", "Ring", "tyre: ring on an elastic foundation, analytic or of elements", true, false},
        {"oscillator", "Oscillator", "mass on a spring and a damper under its weight", false, false},
        {"mesh", "Mesh", "hexahedra with named groups from a gmsh file", true, true},
    };
    return types;
  }

  const BodyType &BodyParameters::body_type() const
  {
    const auto found = std::find_if(types->begin(), types->end(),
                                    [&](const BodyType &candidate) { return candidate.name == type; });
    AssertThrow(found != types->end(), dealii::ExcMessage("unknown type of body " + type));
    return *found;
  }

  bool BodyParameters::is_meshed() const
  {
    return body_type().is_meshed && (type != "ring" || ring.is_meshed());
  }

  std::optional<ContactGrid> BodyParameters::contact_points(const double cell) const
  {
    if (own)
      return own->contact_grid();
    if (type == "layer")
      return layer.grid();
    if (type == "ring")
      return ring.grid();
    if (type == "identified" && identified.positions.size() > 1)
      return identified.grid(cell);
    if (type != "bar" && !takes_cell())
      return {};
    ContactGrid point;
    point.n_x = point.n_y = 1;
    point.spacing_x = point.spacing_y = type == "bar" ? std::sqrt(bar.section) : cell;
    return point;
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
    if (has_groups())
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
    if (has_material() && materials.empty())
      declare("Material", material);
    if (!materials.empty())
    {
      prm.enter_subsection("Material");
      for (auto &[group, own] : materials)
        declare(group, own);
      prm.leave_subsection();
    }
    if (type == "half-space")
      declare("Half-space", half_space);
    if (type == "rigid")
      declare("Rigid", half_space);
    if (type == "bar")
      declare("Bar", bar);
    if (type == "identified")
      declare("Identified", identified);
    if (type == "ring")
      declare("Ring", ring);
    if (type == "oscillator")
      declare("Oscillator", oscillator);
    if (type == "block")
      declare("Block", block);
    if (type == "blade")
      declare("Blade", blade);
    if (type == "layer")
      declare("Layer", layer);
    if (type == "wheel")
      declare("Wheel", wheel);
    if (type == "rail")
      declare("Rail", rail);
    if (type == "beam rail")
      declare("Beam rail", beam_rail);
    if (type == "mesh")
      declare("Mesh", mesh);
    if (own)
      declare(body_type().section, *own);
    if (is_solid())
      declare("Loads", loads);
    if (type == "bar")
    {
      prm.enter_subsection("Loads");
      prm.add_parameter("Gravity", loads.gravity,
                        "Acceleration of gravity along -z; 9.81 on earth. Units: m/s^2.",
                        dealii::Patterns::Double(-1e4, 1e4));
      prm.leave_subsection();
    }
  }

  void BodyParameters::check(const std::string &section) const
  {
    for (const auto &[group, own] : materials)
      own.check(section + "/Material/" + group);
    if (has_material() && materials.empty())
      material.check(section + "/Material");
    if (type == "half-space" || type == "rigid")
      half_space.check(section + "/" + body_type().section);
    if (type == "identified")
      identified.check(section + "/Identified");
    if (type == "bar")
      bar.check(section + "/Bar");
    if (type == "ring")
      ring.check(section + "/Ring");
    if (type == "block")
      block.check(section + "/Block");
    if (type == "blade")
      blade.check(section + "/Blade");
    if (type == "layer")
      layer.check(section + "/Layer");
    if (type == "wheel")
      wheel.check(section + "/Wheel");
    if (type == "rail")
      rail.check(section + "/Rail");
    if (type == "beam rail")
      beam_rail.check(section + "/Beam rail");
    if (type == "mesh")
      mesh.check(section + "/Mesh");
    if (own)
      own->check(section + "/" + body_type().section);
    if (is_solid())
      loads.check(section + "/Loads");
  }

  bool BodyParameters::has_loss() const
  {
    if (type == "ring")
      return ring.damping_ratio > 0;
    const auto supports = [](const RailSupports &rail)
    { return !rail.anechoic_lengths.empty() || (rail.has_pads() && rail.pad_loss_factor > 0); };
    return material_loss_factor() > 0 || (type == "rail" && supports(rail)) ||
           (type == "beam rail" && supports(beam_rail)) ||
           (type == "mesh" && mesh.foundation_loss_factor > 0);
  }

  double BodyParameters::material_loss_factor() const
  {
    double loss = materials.empty() ? material.loss_factor : 0;
    for (const auto &group : materials)
      loss = std::max(loss, group.second.loss_factor);
    return loss;
  }

  std::optional<SectionOutline> BodyParameters::wheel_section() const
  {
    if (type == "wheel")
      return wheel.section.read_outline(wheel.scale);
    if (is_wheel())
      return wheel_outline(mesh);
    return {};
  }

  std::optional<double> BodyParameters::axle_height(const double lateral_position) const
  {
    if (!is_wheel())
      return {};
    return tread_radius(*wheel_section(), lateral_position);
  }

  std::optional<FlatFace> BodyParameters::flat_face(const double lateral_position) const
  {
    if (type == "block")
      return block.contact_rectangle(lateral_position);
    if (type == "mesh" && !mesh.is_wheel())
      return flat_contact_group(mesh);
    return {};
  }

  std::optional<std::pair<double, double>> BodyParameters::contact_limits() const
  {
    if (!is_wheel())
      return {};
    return tread_limits(*wheel_section());
  }
} // namespace vibrocontact
