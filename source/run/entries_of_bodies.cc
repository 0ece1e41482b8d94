#include <vibrocontact/base/declared_parameters.h>
#include <vibrocontact/base/parameter_text.h>
#include <vibrocontact/run/entries_of_bodies.h>
#include <vibrocontact/scene/identified.h>
#include <vibrocontact/scene/rail.h>

#include <algorithm>

namespace vibrocontact
{
  namespace
  {
    /// Section Identification of a body that is known by its data.
    void add_identification(EntriesRead &entries, const IdentificationParameters &identification,
                            const std::string &section, const IdentifiedParameters &body, const BodyUse &use)
    {
      const bool data = body.takes_data(), fit = data && !body.inverse_transform;
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
      if (body.description->has_groups())
        entries.add(body.name, "Materials");
      std::vector<std::string> sections;
      for (const auto &group : body.materials)
        sections.push_back(body.name + "/Material/" + group.first);
      if (sections.empty())
        sections.push_back(body.name + "/Material");
      const bool has_elements = body.is_meshed() || body.description->periodic_rail();
      for (unsigned int k = 0; k < sections.size(); ++k)
      {
        const std::string &section = sections[k];
        const ElasticMaterial &material = body.materials.empty() ? body.material : body.materials[k].second;
        const bool orthotropic = material.is_orthotropic();
        const std::string isotropic = section + "/Orthotropic is left out";
        entries.add_if(!orthotropic, isotropic, section, "Young modulus");
        entries.add_if(!orthotropic && !body.description->moves_along_z_only(),
                       orthotropic ? isotropic : "the body does not move along z alone", section,
                       "Poisson ratio");
        if (body.may_be_orthotropic())
        {
          const std::string own = section + "/Orthotropic";
          entries.add(own, "E1, E2, E3, nu12, nu13, nu23, G12, G13, G23");
          entries.add_if(orthotropic, "constants of an orthotropic material are given", own,
                         "Axis 1, Axis 2");
        }
        // of several materials each has to name its density
        entries.add_if(!body.materials.empty() || (has_elements && (use.motion || use.heavy)),
                       "the body moves or has a Gravity", section, "Density");
        entries.add_if(has_elements && use.loss, "the body moves", section, "Loss factor");
      }
    }

    void add_modes(EntriesRead &entries, const BodyParameters &body, const ModeParameters &modes,
                   const BodyUse &use)
    {
      const std::string section = body.name + "/Modes", moves = "the analysis moves the body by its modes";
      entries.add_if(use.motion, moves, section, "Upper frequency, Count");
      const bool kept = use.motion && modes.any(), wheel = body.description->is_wheel();
      entries.add_if(kept && wheel, moves + " and it is a wheel", section, "Rim radius");
      entries.add_if(kept && wheel && use.loss, moves + " and it is a wheel", section,
                     "Damping ratio 0 nodal diameters, Damping ratio 1 nodal diameter, "
                     "Damping ratio 2 nodal diameters");
      entries.add_if(kept && use.scaled_damping, moves, section, "Stiffness damping");
      entries.add_if(kept && use.scaled_damping && (wheel || body.has_loss()), moves + " and it has damping",
                     section, "Damping factor");
    }
    void add_rotation(EntriesRead &entries, const BodyParameters &body, const BodyUse &use)
    {
      const std::string section = body.name + "/Rotation", turns = section + "/Speed is not 0";
      entries.add(section, "Speed");
      entries.add_if(body.rotation.turns(), turns, section, "Axis, Point on axis");
      entries.add_if(body.rotation.turns() && use.motion, turns + " and the body moves", section, "Coriolis");
    }
  } // namespace

  void add_pole_numbers(EntriesRead &entries, const IdentificationParameters &identification,
                        const bool is_read, const std::string &condition)
  {
    const std::string section = "Identification";
    const bool by_target = identification.target_error > 0;
    const std::vector<FitMethod> methods = identification.method_list();
    const bool by_relocation = std::any_of(methods.begin(), methods.end(),
                                           [](const FitMethod &method) { return method.relocates_poles; });
    entries.add_if(is_read && !by_target, condition + ", without a Target error", section,
                   "Numbers of pole pairs");
    entries.add_if(is_read && by_target, condition + ", with a Target error", section,
                   "Largest number of pole pairs");
    entries.add_if(is_read && by_relocation, condition + " by vector fitting", section, "Iterations");
  }

  void add_all_entries(EntriesRead &entries, const std::string &section, ParameterGroup &group)
  {
    dealii::ParameterHandler prm;
    group.declare_parameters(prm);
    for (const DeclaredParameters::Entry &entry : declared_parameters(prm).entries)
      entries.add(section, joined_path(entry.section, entry.name));
  }

  void add_body(EntriesRead &entries, const Parameters &parameters, const unsigned int number,
                const BodyUse &needed)
  {
    const BodyParameters &body = parameters.scene.bodies[number];
    const std::string section = body.name + "/" + body.body_type().section;
    BodyUse use = needed;
    // its modes are what its material flows in
    if (use.contact && body.rolls())
      use.motion = use.loss = use.scaled_damping = true;
    // their stress stiffens it
    use.loads = use.loads || (body.is_solid() && body.is_prestressed());
    use.heavy = (use.loads && body.loads.gravity != 0) || body.rotation.turns();
    use.in_a_point = parameters.touches_in_a_point();
    if (body.description->has_material())
      add_material(entries, body, use);
    if (body.is_meshed())
      add_modes(entries, body, parameters.modes.at(body.name), use);
    if (body.is_solid() || body.description->takes_gravity())
      entries.add_if(use.loads, "loads matter to the analysis", body.name + "/Loads", "Gravity");
    if (body.description->may_turn())
      add_rotation(entries, body, use);
    if (body.is_solid())
    {
      entries.add(body.name + "/Solver", "Method");
      const std::vector<double> &traction = body.loads.traction;
      entries.add_if(use.loads && traction != std::vector<double>(traction.size()),
                     "loads matter to the analysis and there is a Traction", body.name + "/Loads",
                     "Traction boundary");
      entries.add_if(use.loads && !body.loads.traction_boundary.empty(),
                     "loads matter to the analysis and there is a Traction boundary", body.name + "/Loads",
                     "Traction");
      entries.add_if(use.loads && body.loads.pressure != 0,
                     "loads matter to the analysis and there is a Pressure", body.name + "/Loads",
                     "Pressure boundary");
      entries.add_if(use.loads && !body.loads.pressure_boundary.empty(),
                     "loads matter to the analysis and there is a Pressure boundary", body.name + "/Loads",
                     "Pressure");
      entries.add_if(body.loads.any() && !body.rotation.turns(),
                     "there are loads and the body does not turn, by which it is prestressed anyway",
                     body.name + "/Loads", "Prestress");
    }
    // of a fresh one: to declare entries sets what they are bound to
    if (!body.description->add_entries(entries, section, use))
      add_all_entries(entries, section, *body.body_type().make());
    if (const IdentifiedParameters *const measured = body.description->measured())
      add_identification(entries, parameters.identification, section, *measured, use);
  }
} // namespace vibrocontact
