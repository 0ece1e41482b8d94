#include <vibrocontact/base/declared_parameters.h>
#include <vibrocontact/base/parameter_text.h>
#include <vibrocontact/run/entries_of_bodies.h>

#include <algorithm>

namespace vibrocontact
{
  namespace
  {
    void add_supports(EntriesRead &entries, const std::string &section, const RailSupports &rail,
                      const BodyUse &use, const bool pieces_divide)
    {
      entries.add(section, "Pad stiffness x, Pad stiffness y, Pad stiffness z");
      entries.add_if(rail.has_pads(), "there are pads", section, "Contact at, Sleeper spacing, Pad length");
      entries.add_if(rail.has_pads() && use.loss, "there are pads and the body moves", section,
                     "Pad loss factor");
      entries.add_if(use.loss || pieces_divide, "the body moves", section, "Anechoic lengths");
      entries.add_if(use.loss && !rail.anechoic_lengths.empty(), "the body moves and has Anechoic lengths",
                     section, "Anechoic loss factor first, Anechoic loss factor last");
    }

    void add_refinement(EntriesRead &entries, const std::string &section, const ContactRefinement &refinement,
                        const BodyUse &use)
    {
      entries.add_if(use.contact, "the body is in contact", section, "Contact cell size");
      entries.add_if(use.contact && refinement.cell_size > 0,
                     "the body is in contact and has a Contact cell size", section,
                     "Refinement margin, Refinement depth");
    }

    void add_ring(EntriesRead &entries, const std::string &section, const RingParameters &ring,
                  const BodyUse &use)
    {
      const bool analytic = !ring.is_meshed();
      entries.add(section, "Model, Radius, Thickness, Width, Young modulus, Radial foundation stiffness, "
                           "Circumferential foundation stiffness, Inflation pressure");
      entries.add_if(use.motion || ring.rolling, "the ring moves", section, "Density");
      entries.add_if(use.loss || ring.rolling, "the ring moves", section, "Damping ratio");
      entries.add_if(ring.pressure != 0, "there is an Inflation pressure", section, "Pressure");
      entries.add_if(analytic, "Model is analytic", section, "Rolling, Highest order, Residual");
      entries.add_if(analytic && ring.residual, "Model is analytic and Residual is true", section,
                     "Residual order");
      entries.add_if(!analytic, "Model is beam elements or solid elements", section, "Divisions");
      entries.add_if(ring.model == "solid elements", "Model is solid elements", section, "Element degree");
      entries.add_if(use.contact, "the ring is in contact", section, "Contact points, Tread stiffness");
      entries.add_if(use.contact && (ring.n_points > 1 || (use.tangential && ring.rolling)),
                     "there are several Contact points or the ring rolls with friction", section,
                     "Contact spacing");
      entries.add_if(use.contact && use.tangential, "the contact points move along the road", section,
                     "Tread tangential stiffness");
    }

    void add_oscillator(EntriesRead &entries, const std::string &section,
                        const OscillatorParameters &oscillator, const BodyUse &use)
    {
      entries.add(section, "Stiffness");
      entries.add_if(use.motion || (use.loads && oscillator.gravity != 0), "it moves or has a Gravity",
                     section, "Mass");
      entries.add_if(use.loss, "it moves", section, "Damping ratio");
      entries.add_if(use.loads, "it stands under its weight", section, "Gravity");
      const std::string along = "it moves along the road";
      entries.add_if(use.tangential, along, section, "Tangential stiffness");
      entries.add_if(use.tangential && use.motion, along, section,
                     "Tangential mass, Tangential damping ratio");
    }

    void add_identified(EntriesRead &entries, const Parameters &parameters, const std::string &section,
                        const IdentifiedParameters &body, const BodyUse &use)
    {
      const IdentificationParameters &identification = parameters.identification;
      entries.add(section, "Poles file, Inverse transform");
      entries.add_if(use.contact, "the body is in contact", section, "Positions, Tread stiffness");
      entries.add_if(use.contact && !body.positions.empty(), "there are Positions", section, "Radius");
      const bool data = body.poles_file.empty(), fit = data && !body.inverse_transform;
      const std::string no_poles = section + "/Poles file is empty", fitted = "poles are fitted to the data";
      entries.add_if(data, no_poles, "Identification",
                     "Data file, Rolling data, Lower frequency, Upper frequency, Delay, Passive data");
      entries.add_if(!body.inverse_transform, fitted, "Identification", "Residue tolerance");
      entries.add_if(fit, fitted, "Identification",
                     "Method, Target error, Direct term, Impose zero initial value, Enforce passivity");
      add_pole_numbers(entries, identification, fit, fitted);
      const bool judged = fit && (use.contact ? body.tread_stiffness == 0 : identification.contact_step > 0);
      entries.add_if(judged, "the model is judged for rigid contact", "Identification", "Repair for contact");
      entries.add_if(fit && !use.contact, fitted, "Identification", "Contact time step");
    }

    void add_material(EntriesRead &entries, const BodyParameters &body, const BodyUse &use)
    {
      if (body.has_groups())
        entries.add(body.name, "Materials");
      std::vector<std::string> sections;
      for (const auto &group : body.materials)
        sections.push_back(body.name + "/Material/" + group.first);
      if (sections.empty())
        sections.push_back(body.name + "/Material");
      const bool heavy = use.loads && body.loads.gravity != 0;
      for (const std::string &section : sections)
      {
        entries.add(section, "Young modulus");
        entries.add_if(body.type != "bar", "the body is no bar", section, "Poisson ratio");
        // of several materials each has to name its density
        entries.add_if(!body.materials.empty() || (body.is_meshed() && (use.motion || heavy)),
                       "the body moves or has a Gravity", section, "Density");
        entries.add_if(body.is_meshed() && use.loss, "the body moves", section, "Loss factor");
      }
    }

    void add_modes(EntriesRead &entries, const BodyParameters &body, const ModeParameters &modes,
                   const BodyUse &use)
    {
      const std::string section = body.name + "/Modes", moves = "the analysis moves the body by its modes";
      entries.add_if(use.motion, moves, section, "Upper frequency, Count");
      const bool kept = use.motion && modes.any(), wheel = body.is_wheel();
      entries.add_if(kept && wheel, moves + " and it is a wheel", section, "Rim radius");
      entries.add_if(kept && wheel && use.loss, moves + " and it is a wheel", section,
                     "Damping ratio 0 nodal diameters, Damping ratio 1 nodal diameter, "
                     "Damping ratio 2 nodal diameters");
      entries.add_if(kept && use.scaled_damping, moves, section, "Stiffness damping");
      entries.add_if(kept && use.scaled_damping && (wheel || body.has_loss()), moves + " and it has damping",
                     section, "Damping factor");
    }
  } // namespace

  void add_pole_numbers(EntriesRead &entries, const IdentificationParameters &identification,
                        const bool is_read, const std::string &condition)
  {
    const std::string section = "Identification";
    const bool by_target = identification.target_error > 0;
    const std::vector<std::string> methods = identification.method_list();
    entries.add_if(is_read && !by_target, condition + ", without a Target error", section,
                   "Numbers of pole pairs");
    entries.add_if(is_read && by_target, condition + ", with a Target error", section,
                   "Largest number of pole pairs");
    entries.add_if(is_read && std::count(methods.begin(), methods.end(), "vector fitting") > 0,
                   condition + " by vector fitting", section, "Iterations");
  }

  void add_all_entries(EntriesRead &entries, const std::string &section, ParameterGroup &group)
  {
    dealii::ParameterHandler prm;
    group.declare_parameters(prm);
    for (const DeclaredParameters::Entry &entry : declared_parameters(prm).entries)
      entries.add(section, joined_path(entry.section, entry.name));
  }

  void add_body(EntriesRead &entries, const Parameters &parameters, const unsigned int number,
                const BodyUse &use)
  {
    const BodyParameters &body = parameters.scene.bodies[number];
    const std::string section = body.name + "/" + body.body_type().section;
    if (body.has_material())
      add_material(entries, body, use);
    if (body.is_meshed())
      add_modes(entries, body, parameters.modes.at(body.name), use);
    if (body.is_solid() || body.type == "bar")
      entries.add_if(use.loads, "loads matter to the analysis", body.name + "/Loads", "Gravity");
    if (body.is_solid())
    {
      const std::vector<double> &traction = body.loads.traction;
      entries.add_if(use.loads && traction != std::vector<double>(traction.size()),
                     "loads matter to the analysis and there is a Traction", body.name + "/Loads",
                     "Traction boundary");
      entries.add_if(use.loads && !body.loads.traction_boundary.empty(),
                     "loads matter to the analysis and there is a Traction boundary", body.name + "/Loads",
                     "Traction");
    }

    if (body.own)
      add_all_entries(entries, section, *body.body_type().make());
    else if (body.type == "half-space" || body.type == "rigid")
    {
      const bool in_a_point = std::any_of(parameters.scene.bodies.begin(), parameters.scene.bodies.end(),
                                          [](const BodyParameters &other) { return other.is_point(); });
      entries.add_if(use.contact && !in_a_point, "its surface is in contact, and not in one point of a bar",
                     section, "Radius x, Radius y");
    }
    else if (body.type == "bar")
    {
      entries.add(section, "Length, Section, Divisions, Element degree, Far end");
      entries.add_if(use.motion || (use.loads && body.loads.gravity != 0), "the body moves or has a Gravity",
                     section, "Consistent mass, Massless contact node");
    }
    else if (body.type == "block")
      entries.add(section,
                  "Length, Width, Height, Divisions x, Divisions y, Divisions z, Contact face, Held, "
                  "Offset x, Offset y");
    else if (body.type == "blade")
      entries.add(section, "Length, Chord, Thickness, Root angle, Tip angle, Length divisions, "
                           "Chord divisions, Thickness divisions, Element degree");
    else if (body.type == "layer")
    {
      entries.add(section, "Length, Height, Width, Divisions x, Divisions z, Element degree");
      entries.add_if(!body.layer.plane_strain(), "Width is given", section, "Divisions y");
    }
    else if (body.type == "wheel")
    {
      entries.add(section, "Section mesh, Section outline, Section refinements, Element degree, Write mesh, "
                           "Scale, Contact division, Coarse division, Growth, Fine length");
      add_refinement(entries, section, body.wheel.refinement, use);
    }
    else if (body.type == "rail")
    {
      entries.add(section, "Section mesh, Section outline, Section refinements, Element degree, Length, "
                           "Lateral position, Contact division, Coarse division, Growth, Fine length");
      add_supports(entries, section, body.rail, use, false);
      add_refinement(entries, section, body.rail.refinement, use);
    }
    else if (body.type == "beam rail")
    {
      entries.add(section,
                  "Length, Area, Moment of area y, Moment of area z, Torsion constant, Warping constant, "
                  "Shear coefficient z, Shear coefficient y, Centroid height, Shear centre height, "
                  "Element length, Element degree");
      entries.add_if(use.contact || use.points, "places on its crown are observed", section,
                     "Lateral position, Height");
      entries.add_if(use.contact || (use.points && body.beam_rail.lateral_position != 0),
                     "the body is in contact, or is observed beside its Lateral position 0", section,
                     "Crown radius");
      entries.add_if(body.beam_rail.has_pads(), "there are pads", section, "Foot width");
      add_supports(entries, section, body.beam_rail, use, true);
    }
    else if (body.type == "mesh")
    {
      entries.add(section, "File, Unit, Contact point, Held groups, Foundation groups, Geometry, "
                           "Element degree");
      entries.add_if(use.contact, "the body is in contact", section, "Contact group");
      const bool springs = !body.mesh.foundation_groups.empty();
      entries.add_if(springs, "there are Foundation groups", section, "Foundation stiffness");
      entries.add_if(springs && use.loss, "there are Foundation groups and the body moves", section,
                     "Foundation loss factor");
      entries.add_if(body.mesh.is_wheel(), "Geometry is wheel", section, "Wheel outline, Wheel scale");
      add_refinement(entries, section, body.mesh.refinement, use);
    }
    else if (body.type == "ring")
      add_ring(entries, section, body.ring, use);
    else if (body.type == "oscillator")
      add_oscillator(entries, section, body.oscillator, use);
    else if (body.type == "identified")
      add_identified(entries, parameters, section, body.identified, use);
  }
} // namespace vibrocontact
