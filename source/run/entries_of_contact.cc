#include <vibrocontact/run/entries_of_contact.h>

#include <algorithm>
#include <utility>

namespace vibrocontact
{
  namespace
  {
    bool moves_with_the_lateral_position(const Parameters &parameters)
    {
      for (const BodyParameters &body : parameters.scene.bodies)
        if (body.description->is_wheel() ||
            (&body == &parameters.scene.bodies[0] && body.description->follows_lateral_position()))
          return true;
      return parameters.lateral_sweep() != nullptr;
    }

    /// @param swept in place of the contact's own; empty: none
    double largest_friction(const ContactParameters &contact, const std::vector<double> &swept)
    {
      return swept.empty() ? contact.friction : *std::max_element(swept.begin(), swept.end());
    }

    /// @param condition in words of what holds where the law acts
    void add_friction_law(EntriesRead &entries, const ContactParameters &contact, const bool rubs,
                          const std::string &condition)
    {
      const std::string &section = contact.section;
      entries.add_if(rubs, condition, section, "Friction law");
      entries.add_if(rubs && contact.friction_law.empty(),
                     condition + " and " + section + "/Friction law is empty", section,
                     "Static friction ratio");
      const std::string own = contact.friction_entry().name;
      for (const FrictionLawEntry &law : contact.laws->friction)
        for (const LawParameter &parameter : law.parameters)
          if (parameter.name != friction_coefficient().name)
            entries.add_if(rubs && law.name == own,
                           condition + " and the " + section + "/Friction law is " + law.name, section,
                           parameter.name);
    }
  } // namespace

  void add_friction_coefficient(EntriesRead &entries, const ContactParameters &contact)
  {
    entries.add_if(contact.takes_coefficient(), "the " + contact.section + "/Friction law is scaled by it",
                   contact.section, "Friction coefficient");
  }

  void add_friction(EntriesRead &entries, const ContactParameters &contact, const bool rubs,
                    const std::string &condition)
  {
    entries.add_if(rubs && contact.takes_coefficient(),
                   condition + " and the " + contact.section + "/Friction law is scaled by it",
                   contact.section, "Friction coefficient");
    add_friction_law(entries, contact, rubs, condition);
  }

  void add_lateral_position(EntriesRead &entries, const Parameters &parameters)
  {
    entries.add_if(moves_with_the_lateral_position(parameters), "body 1 is a wheel or a block",
                   parameters.contact().section, "Lateral position");
  }

  void add_contact_grid(EntriesRead &entries, const Parameters &parameters)
  {
    for (unsigned int k = 0; k < parameters.contacts.all.size(); ++k)
    {
      const ContactParameters &contact = parameters.contacts.all[k];
      const std::string &section = contact.section;
      std::vector<const BodyParameters *> bodies;
      for (const BodyParameters &body : parameters.scene.bodies)
        if (contact.name.empty() || std::count(contact.bodies.begin(), contact.bodies.end(), body.name) > 0)
          bodies.push_back(&body);
      const bool own = std::none_of(bodies.begin(), bodies.end(),
                                    [](const BodyParameters *const body)
                                    { return body->description->contact_points(1).has_value(); }),
                 cells = std::none_of(bodies.begin(), bodies.end(),
                                      [](const BodyParameters *const body) {
                                        return body->description->contact_points(1) &&
                                               !body->description->takes_cell();
                                      });
      const std::string whose = "no body (bar, layer, ring, oscillator) brings its own contact points";
      entries.add_if(cells, "no body (bar, layer, ring) brings its own cells", section, "Grid spacing");
      entries.add_if(own, whose, section, "Half length, Strip length, Offset x, Quadrature");
      entries.add_if(own && contact.strip_length == 0, whose + " and Strip length is 0", section,
                     "Half width, Offset y");
      if (!contact.name.empty())
        entries.add(section, "Bodies, Origin, Origin on body 2, Normal, Gap");
    }
    add_lateral_position(entries, parameters);
  }

  void add_contact_solver(EntriesRead &entries, const Parameters &parameters, const bool holds,
                          const std::string &condition)
  {
    const std::string section = "Contact/Solver", also = condition.empty() ? "" : condition + " and ";
    entries.add_if(holds, condition, section, "Method");
    for (const ContactSolverEntry &row : *parameters.contact_solver.methods)
      entries.add_if(holds && row.name == parameters.contact_solver.method, also + "Method is " + row.name,
                     section, row.entries);
  }

  void add_normal_law(EntriesRead &entries, const ContactParameters &contact, const std::string &name,
                      const std::string &entry)
  {
    for (const NormalLawEntry &law : contact.laws->normal)
      for (const LawParameter &parameter : law.parameters)
        entries.add_if(law.name == name, entry + " is " + law.name, contact.section, parameter.name);
  }

  void add_contacts_at_rest(EntriesRead &entries, const Parameters &parameters,
                            const std::vector<double> &swept_friction)
  {
    const auto any_body = [&](const auto &is)
    { return std::any_of(parameters.scene.bodies.begin(), parameters.scene.bodies.end(), is); };
    add_contact_grid(entries, parameters);
    add_contact_solver(entries, parameters);
    for (const ContactParameters &contact : parameters.contacts.all)
    {
      const std::string &section = contact.section;
      const double friction = largest_friction(contact, swept_friction);
      entries.add(section, "Normal law");
      add_normal_law(entries, contact, contact.normal_law, section + "/Normal law");
      entries.add_if(any_body([](const BodyParameters &body) { return body.is_solid(); }),
                     "a body is a solid of finite elements", section, "Local flexibility");
      const std::string rubs = "there is friction";
      entries.add_if(friction > 0, rubs, section, "Normal-tangential coupling");
      add_friction_law(entries, contact, friction > 0, rubs);
    }
  }

  void add_contacts(EntriesRead &entries, const Parameters &parameters,
                    const std::vector<double> &swept_friction, const std::string &unmet)
  {
    add_contacts_at_rest(entries, parameters, swept_friction);
    const bool rolls = parameters.rolling.creepage.speed > 0;
    for (const ContactParameters &contact : parameters.contacts.all)
    {
      const std::string &section = contact.section;
      entries.add_if(rolls && unmet.empty(),
                     "Rolling/Speed is above 0" + (unmet.empty() ? "" : " and " + unmet), section,
                     "Creep scheme");
      if (contact.name.empty())
        continue;
      const double friction = largest_friction(contact, swept_friction);
      const std::string rubs = "there is friction";
      entries.add_if(friction > 0, rubs, section, "Sliding velocity x, Sliding velocity y");
      entries.add_if(friction > 0 && !parameters.touches_in_a_point(),
                     rubs + " and more than one point touches", section, "Sliding rotation");
      entries.add_if(friction > 0 && rolls, rubs + " and Rolling/Speed is above 0", section,
                     "Longitudinal creepage, Lateral creepage, Spin");
    }
  }

  void add_sliding(EntriesRead &entries, const Parameters &parameters, const bool rubs,
                   const std::string &condition)
  {
    entries.add_if(rubs, condition, "Rolling", "Sliding velocity x, Sliding velocity y");
    const bool turns = !parameters.touches_in_a_point() || !parameters.contact().name.empty();
    entries.add_if(rubs && turns,
                   (condition.empty() ? "" : condition + " and ") +
                       "more than the point that it turns about touches",
                   "Rolling", "Sliding rotation");
  }

  void add_rolling_cases(EntriesRead &entries, const Parameters &parameters)
  {
    const RollingParameters &rolling = parameters.rolling;
    const RollingParameters::Sweep &sweep = rolling.sweep;
    const std::vector<std::pair<std::string, const std::vector<double> *>> curves = {
        {"Longitudinal creepage", &sweep.longitudinal},
        {"Lateral creepage", &sweep.lateral},
        {"Spin", &sweep.spin},
        {"Normal force", &sweep.normal_force},
        {"Hub displacement", &sweep.hub_displacement}};
    const unsigned int n_curves =
        std::count_if(curves.begin(), curves.end(), [](const auto &curve) { return !curve.second->empty(); });
    const bool rolls = rolling.creepage.speed > 0;
    for (const auto &[name, values] : curves)
    {
      const bool is_load = name == "Normal force" || name == "Hub displacement",
                 is_single = n_curves == 0 || n_curves > 1 || values->empty();
      entries.add_if(is_single && (rolls || is_load),
                     std::string(is_load ? "" : "Rolling/Speed is above 0 and ") +
                         "no sweep of its own takes its place",
                     "Rolling", name);
      entries.add_if(rolls || is_load, "Rolling/Speed is above 0", "Rolling/Sweep", name);
    }
    entries.add("Rolling", "Speed");
    add_sliding(entries, parameters);
    entries.add("Rolling/Sweep", "Friction coefficient");
    for (const ContactParameters &contact : parameters.contacts.all)
      entries.add_if(sweep.friction.empty() && contact.takes_coefficient(),
                     "Rolling/Sweep/Friction coefficient is empty and the " + contact.section +
                         "/Friction law is scaled by it",
                     contact.section, "Friction coefficient");
  }

  void add_load_history(EntriesRead &entries, const Parameters &parameters)
  {
    const LoadingParameters &own = parameters.loading;
    entries.add("Loading", "Table");
    entries.add_if(own.table.empty(), "Loading/Table is empty", "Loading",
                   "Normal force, Hub displacement, Steps");
    entries.add_if(own.table.empty() && parameters.largest_friction() > 0,
                   "Loading/Table is empty and there is friction", "Loading",
                   "Force x, Displacement x, Force y, Displacement y");
  }

  void add_hub(EntriesRead &entries, const Parameters &parameters)
  {
    const HubKind &hub = hub_kind(parameters.hub());
    entries.add_if(hub.exists(), "body 1 has a hub", "Rolling", "Hub");
    entries.add_if(hub.has_unsprung_mass, "Rolling/Hub is suspended", "Rolling/Suspension", "Unsprung mass");
    entries.add_if(hub.has_axle, "Rolling/Hub is axle", "Rolling/Axle",
                   "Length, Radius, Inner radius, Box distance, Box mass, Upper frequency");
    entries.add_if(hub.has_axle, "Rolling/Hub is axle", "Rolling/Axle/Material",
                   "Young modulus, Poisson ratio, Density, Loss factor");
    entries.add_if(hub.has_mass(), "Rolling/Hub is suspended or axle", "Rolling/Suspension",
                   "Stiffness x, Stiffness y, Stiffness z, Damping x, Damping y, Damping z");
  }

  void add_motion_in_contact(EntriesRead &entries, const Parameters &parameters)
  {
    add_partners(entries, parameters, moving_in_contact());
    add_contacts(entries, parameters);
    for (const ContactParameters &contact : parameters.contacts.all)
      add_friction_coefficient(entries, contact);
    add_hub(entries, parameters);
  }

  void add_partners(EntriesRead &entries, const Parameters &parameters, const BodyUse &use)
  {
    BodyUse own = use;
    own.tangential = largest_friction_of_cases(parameters) > 0;
    for (unsigned int k = 0; k < parameters.scene.bodies.size(); ++k)
      add_body(entries, parameters, k, own);
  }

  double largest_friction_of_cases(const Parameters &parameters)
  {
    const std::vector<double> &swept = parameters.rolling.sweep.friction;
    return swept.empty() ? parameters.largest_friction() : *std::max_element(swept.begin(), swept.end());
  }

  BodyUse moving_in_contact()
  {
    BodyUse use;
    use.contact = use.loads = use.motion = use.loss = use.scaled_damping = true;
    return use;
  }
} // namespace vibrocontact
