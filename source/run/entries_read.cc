#include <vibrocontact/analyses/drive.h>
#include <vibrocontact/base/parameter_text.h>
#include <vibrocontact/run/check_transient.h>
#include <vibrocontact/run/entries_of_bodies.h>
#include <vibrocontact/run/entries_read.h>

#include <algorithm>
#include <functional>
#include <utility>

namespace vibrocontact
{
  namespace
  {
    bool moves_with_the_lateral_position(const Parameters &parameters)
    {
      for (const BodyParameters &body : parameters.scene.bodies)
        if (body.is_wheel() || (&body == &parameters.scene.bodies[0] && body.type == "block"))
          return true;
      return parameters.scene.runs("stability") &&
             parameters.stability.sweep.sweeps(ParameterSweep::lateral_position);
    }

    void add_lateral_position(EntriesRead &entries, const Parameters &parameters)
    {
      entries.add_if(moves_with_the_lateral_position(parameters), "body 1 is a wheel or a block", "Contact",
                     "Lateral position");
    }

    void add_contact_grid(EntriesRead &entries, const Parameters &parameters)
    {
      const std::vector<BodyParameters> &bodies = parameters.scene.bodies;
      const bool own = std::none_of(bodies.begin(), bodies.end(),
                                    [](const BodyParameters &body) {
                                      return body.is_point() || body.type == "layer" || body.type == "ring";
                                    });
      const std::string whose = "no body (bar, layer, ring) brings its own contact points";
      entries.add_if(own, whose, "Contact", "Grid spacing, Half length, Strip length, Offset x, Quadrature");
      entries.add_if(own && parameters.contact.strip_length == 0, whose + " and Strip length is 0", "Contact",
                     "Half width, Offset y");
      add_lateral_position(entries, parameters);
    }

    void add_contact_solver(EntriesRead &entries, const Parameters &parameters, const bool holds = true,
                            const std::string &condition = "")
    {
      const std::string section = "Contact/Solver", also = condition.empty() ? "" : condition + " and ";
      const bool newton = parameters.contact_solver.method == "semi-smooth newton";
      entries.add_if(holds, condition, section, "Method, Tolerance, Force change");
      entries.add_if(holds && newton, also + "Method is semi-smooth newton", section,
                     "Max Newton iterations");
      entries.add_if(holds && !newton, also + "Method is fixed point", section, "Max fixed point iterations");
    }

    void add_normal_law(EntriesRead &entries, const std::string &name, const std::string &entry)
    {
      for (const NormalLawEntry &law : normal_laws())
        for (const LawParameter &parameter : law.parameters)
          entries.add_if(law.name == name, entry + " is " + law.name, "Contact", parameter.name);
    }

    /// @param condition in words of what holds where the law acts
    void add_friction_law(EntriesRead &entries, const ContactParameters &contact, const bool rubs,
                          const std::string &condition)
    {
      entries.add_if(rubs, condition, "Contact", "Friction law");
      entries.add_if(rubs && contact.friction_law.empty(), condition + " and Contact/Friction law is empty",
                     "Contact", "Static friction ratio");
      const std::string own = contact.friction_entry().name;
      for (const FrictionLawEntry &law : friction_laws())
        for (const LawParameter &parameter : law.parameters)
          if (parameter.name != friction_coefficient().name)
            entries.add_if(rubs && law.name == own,
                           condition + " and the Contact/Friction law is " + law.name, "Contact",
                           parameter.name);
    }

    /// Contact of two bodies with friction: grid, laws, solver. @param largest_friction of all cases
    void add_contact(EntriesRead &entries, const Parameters &parameters, const double largest_friction)
    {
      const ContactParameters &contact = parameters.contact;
      const auto any_body = [&](const auto &is)
      { return std::any_of(parameters.scene.bodies.begin(), parameters.scene.bodies.end(), is); };
      add_contact_grid(entries, parameters);
      add_contact_solver(entries, parameters);
      entries.add("Contact", "Normal law");
      add_normal_law(entries, contact.normal_law, "Contact/Normal law");
      entries.add_if(any_body([](const BodyParameters &body) { return body.is_solid(); }),
                     "a body is a solid of finite elements", "Contact", "Local flexibility");
      entries.add_if(parameters.rolling.creepage.speed > 0, "Rolling/Speed is above 0", "Contact",
                     "Creep scheme");
      const std::string rubs = "there is friction";
      entries.add_if(largest_friction > 0, rubs, "Contact", "Normal-tangential coupling");
      add_friction_law(entries, contact, largest_friction > 0, rubs);
    }

    /// Cases of rolling and of the equilibria of stability.
    void add_rolling_cases(EntriesRead &entries, const RollingParameters &rolling,
                           const ContactParameters &contact)
    {
      const RollingParameters::Sweep &sweep = rolling.sweep;
      const std::vector<std::pair<std::string, const std::vector<double> *>> curves = {
          {"Longitudinal creepage", &sweep.longitudinal},
          {"Lateral creepage", &sweep.lateral},
          {"Spin", &sweep.spin},
          {"Normal force", &sweep.normal_force},
          {"Hub displacement", &sweep.hub_displacement}};
      const unsigned int n_curves = std::count_if(curves.begin(), curves.end(),
                                                  [](const auto &curve) { return !curve.second->empty(); });
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
      entries.add("Rolling", "Speed, Sliding velocity x, Sliding velocity y");
      entries.add("Rolling/Sweep", "Friction coefficient");
      entries.add_if(
          sweep.friction.empty() && contact.takes_coefficient(),
          "Rolling/Sweep/Friction coefficient is empty and the Contact/Friction law is scaled by it",
          "Contact", "Friction coefficient");
    }

    /// What becomes of the hub of body 1 once the load has found its place.
    void add_hub(EntriesRead &entries, const Parameters &parameters)
    {
      entries.add_if(parameters.hub() != "none", "body 1 has a hub", "Rolling", "Hub");
      entries.add_if(parameters.hub() == "suspended", "Rolling/Hub is suspended", "Rolling/Suspension",
                     "Unsprung mass, Stiffness x, Stiffness y, Stiffness z, Damping x, Damping y, Damping z");
    }

    /// Two bodies in contact; none of them is known by its Green's functions.
    void add_partners(EntriesRead &entries, const Parameters &parameters, const BodyUse &use)
    {
      for (unsigned int k = 0; k < parameters.scene.bodies.size(); ++k)
        if (!parameters.scene.bodies[k].is_green())
          add_body(entries, parameters, k, use);
    }

    double largest_friction(const Parameters &parameters)
    {
      const std::vector<double> &swept = parameters.rolling.sweep.friction;
      return swept.empty() ? parameters.contact.friction : *std::max_element(swept.begin(), swept.end());
    }

    void modes_read(EntriesRead &entries, const Parameters &parameters)
    {
      BodyUse use;
      use.motion = use.loss = use.scaled_damping = true;
      for (unsigned int k = 0; k < parameters.scene.bodies.size(); ++k)
        if (parameters.scene.bodies[k].is_meshed())
          add_body(entries, parameters, k, use);
      add_lateral_position(entries, parameters);
    }

    void frequency_response_read(EntriesRead &entries, const Parameters &parameters)
    {
      const FrequencyResponseParameters &own = parameters.frequency_response;
      const std::vector<std::string> wanted = split_list(own.bodies);
      const std::string section = "Frequency response";
      bool meshed = false, green = false, ring = false, rolls = false, tangential = false;
      for (unsigned int k = 0; k < parameters.scene.bodies.size(); ++k)
      {
        const BodyParameters &body = parameters.scene.bodies[k];
        if (!wanted.empty() && std::count(wanted.begin(), wanted.end(), body.name) == 0)
          continue;
        BodyUse use;
        use.motion = use.loss = use.points = true;
        if (body.is_meshed())
          meshed = true;
        else if (body.is_green())
        {
          green = true;
          ring = ring || body.type == "ring";
          rolls = rolls || (body.type == "ring" && body.ring.rolling);
          // the points of a ring are those of its contact
          use.contact = body.type == "ring";
          use.tangential = tangential = own.tangential;
        }
        else
          continue;
        add_body(entries, parameters, k, use);
      }
      entries.add(section, "Bodies, Quantity, Method, Frequencies");
      entries.add_if(own.list.empty(), section + "/Frequencies is empty", section,
                     "First frequency, Last frequency, Number of frequencies, Spacing");
      entries.add_if(
          meshed, "a body has a mesh", section,
          "Points, Load length, Load width, Check frequencies, Cut frequencies, Refined frequencies");
      entries.add_if(green, "a body is given by its Green's functions", section, "Impulse response time");
      entries.add_if(green && own.impulse_time > 0, section + "/Impulse response time is above 0", section,
                     "Impulse response step");
      entries.add_if(ring, "a body is an analytic ring", section, "Tangential, Truncated orders");
      entries.add_if(rolls, "a ring is Rolling", "Road", "Speed");
      add_lateral_position(entries, parameters);
    }

    void identification_read(EntriesRead &entries, const Parameters &parameters)
    {
      const std::string section = "Identification";
      entries.add(section, "Data file, Rolling data, Lower frequency, Upper frequency, Delay, "
                           "Passive data, Enforce passivity, Method, Target error, Direct term, "
                           "Impose zero initial value, Contact time step, Residue tolerance, "
                           "Stabilisation chart");
      add_pole_numbers(entries, parameters.identification, true, "poles are fitted");
      entries.add_if(parameters.identification.contact_step > 0, section + "/Contact time step is above 0",
                     section, "Repair for contact");
    }

    void rolling_read(EntriesRead &entries, const Parameters &parameters)
    {
      BodyUse use;
      use.contact = use.loads = true;
      use.motion = parameters.contact.replaces_flexibility();
      add_partners(entries, parameters, use);
      add_contact(entries, parameters, largest_friction(parameters));
      add_rolling_cases(entries, parameters.rolling, parameters.contact);
      entries.add("Output", "Contact problems, Contact patches");
      entries.add_if(parameters.output.fields &&
                         std::any_of(parameters.scene.bodies.begin(), parameters.scene.bodies.end(),
                                     [](const BodyParameters &body) { return body.is_solid(); }),
                     "Output/Fields is true and a body is a solid of finite elements", "Output",
                     "Deformation");
    }

    BodyUse moving_in_contact()
    {
      BodyUse use;
      use.contact = use.loads = use.motion = use.loss = use.scaled_damping = true;
      return use;
    }

    void stability_read(EntriesRead &entries, const Parameters &parameters)
    {
      add_partners(entries, parameters, moving_in_contact());
      add_contact(entries, parameters, largest_friction(parameters));
      add_rolling_cases(entries, parameters.rolling, parameters.contact);
      add_hub(entries, parameters);
      const std::string section = "Stability";
      const bool paper = parameters.stability.linearisation == "paper",
                 rolls = parameters.rolling.creepage.speed > 0,
                 plane = std::any_of(parameters.scene.bodies.begin(), parameters.scene.bodies.end(),
                                     [](const BodyParameters &body)
                                     { return body.type == "layer" && body.layer.plane_strain(); });
      const std::string by_paper = "Stability/Linearisation is paper", rolling = "Rolling/Speed is above 0",
                        across = "the bodies move across the slip";
      entries.add(section, "Model, Second count");
      entries.add_if(rolls || !plane, rolling + " or " + across, section, "Linearisation");
      entries.add_if(paper && !plane, by_paper + " and " + across, section, "Lateral damping");
      entries.add_if(paper && rolls, by_paper + " and " + rolling, section, "Convective slip");
      // without rolling all points slide
      entries.add_if(!paper && rolls, "Stability/Linearisation is consistent and " + rolling, section,
                     "Linearise sticking points");
      entries.add_if(parameters.stability.model == "finite elements", "Stability/Model is finite elements",
                     section, "Number of roots");
      entries.add(section + "/Sweep", "Entry, Values, Range, Second entry, Second values, Second range");
    }

    void transient_read(EntriesRead &entries, const Parameters &parameters)
    {
      add_partners(entries, parameters, moving_in_contact());
      add_contact(entries, parameters, parameters.contact.friction);
      entries.add("Contact", "Friction coefficient");
      add_hub(entries, parameters);

      const TransientParameters &own = parameters.transient;
      const std::vector<std::string> driven = driven_entries(own);
      const bool rolls = parameters.rolling.creepage.speed > 0;
      const auto is_driven = [&](const std::string &name)
      { return std::count(driven.begin(), driven.end(), name) > 0; };
      for (const std::string name : {"Longitudinal creepage", "Lateral creepage", "Spin"})
      {
        entries.add_if(rolls && !is_driven(name),
                       "Rolling/Speed is above 0 and section Transient drives no " + name, "Rolling", name);
        entries.add_if(rolls, "Rolling/Speed is above 0", "Transient", name);
      }
      const bool loaded = is_driven("Normal force") || is_driven("Hub displacement");
      entries.add_if(!loaded, "section Transient drives no load", "Rolling",
                     "Normal force, Hub displacement");
      const bool rubs = largest_friction(parameters) > 0;
      entries.add("Rolling", "Speed");
      entries.add_if(rubs, "there is friction", "Rolling", "Sliding velocity x, Sliding velocity y");

      const std::string section = "Transient";
      entries.add(section,
                  "Model, Time step, Error tolerance, End time, Integrator, Reaction, Initial state, "
                  "Perturbed mode, Normal force, Hub displacement, Exciting force, Drive table, "
                  "Error estimate, "
                  "History interval, Checkpoint interval");
      entries.add_if(own.error_tolerance > 0, "Transient/Error tolerance is above 0", section,
                     "Shortest time step");
      entries.add_if(own.integrator == "theta method", "Transient/Integrator is theta method", section,
                     "Theta");
      entries.add_if(own.initial_state == "undeformed", "Transient/Initial state is undeformed", section,
                     "Initial gap, Initial velocity");
      entries.add_if(!own.perturbed_mode.empty(), "there is a Transient/Perturbed mode", section,
                     "Perturbation, Perturbation velocity");
      entries.add(section + "/Roughness", "Expression, Table, Spectrum");
      entries.add_if(!own.roughness.spectrum.empty(), "there is a Transient/Roughness/Spectrum",
                     section + "/Roughness", "Seed");
      const SignalParameters &signals = parameters.signals;
      entries.add(section + "/Signals", "Probes, Table, Spectrum duration, Growth begin, Growth end");
      entries.add_if(parameters.output.fields, "Output/Fields is true", section + "/Signals",
                     "Patch interval");
      entries.add_if(parameters.output.fields && signals.patch_interval > 0,
                     "there is a Transient/Signals/Patch interval", section + "/Signals", "Patch begin");
      entries.add_if(own.initial_state == "quasi-static" && !contact_points_have_mass(own, parameters.scene),
                     "the run starts from an equilibrium, with contact points without mass",
                     section + "/Signals", "Mode amplitudes");
      const bool has_wheel = std::any_of(parameters.scene.bodies.begin(), parameters.scene.bodies.end(),
                                         [](const BodyParameters &body) { return body.is_wheel(); });
      entries.add_if(!signals.probes.empty() && (trimmed(signals.probes) != "rim" || has_wheel) &&
                         own.end_time > least_sound,
                     "there are Transient/Signals/Probes (a rim is that of a wheel) for more than 5 ms",
                     section + "/Signals", "Sound");
    }

    /// @param section Road of body 1 or of a further one
    void add_road(EntriesRead &entries, const std::string &section, const RoadParameters &road,
                  const bool rolls, const bool friction, const bool by_force = false)
    {
      const bool flat = road.profile == "flat", waves = road.profile == "ISO 8608";
      entries.add(section, "Profile, Expression, Table, Indentation");
      entries.add_if(road.profile == "table", section + "/Profile is table", section, "Table interpolation");
      entries.add_if(waves, section + "/Profile is ISO 8608", section,
                     "Class, First wavenumber, Last wavenumber, Wavenumber step, Seed");
      entries.add_if(!flat || rolls, section + "/Profile is not flat", section, "Speed");
      entries.add_if(!flat, section + "/Profile is not flat", section, "Speed expression, Speed table");
      entries.add_if(!flat || road.indentation != 0 || by_force,
                     "there is a profile, an Indentation or a Rolling/Normal force", section, "Loading time");
      entries.add_if(friction, "Modal convolution/Friction is true", section, "Sliding speed");
    }

    bool stands_under_loads(const BodyParameters &body)
    {
      return body.type == "oscillator" ? body.oscillator.gravity != 0
                                       : body.loads.gravity != 0 || !body.loads.traction_boundary.empty();
    }

    bool is_rolling_ring(const BodyParameters &body)
    {
      return body.type == "ring" && body.ring.rolling;
    }

    /// Whether its contact points may have a tread or residual flexibility.
    bool gives_way(const BodyParameters &body)
    {
      return body.type == "ring" ? body.ring.tread_stiffness > 0 || body.ring.residual
                                 : body.type != "oscillator";
    }

    void modal_convolution_read(EntriesRead &entries, const Parameters &parameters)
    {
      const ModalConvolutionParameters &own = parameters.modal_convolution;
      const std::string section = "Modal convolution";
      const std::vector<BodyParameters> &bodies = parameters.scene.bodies;
      BodyUse use = moving_in_contact();
      use.tangential = own.friction;
      add_body(entries, parameters, 0, use);
      if (bodies[0].is_meshed() && bodies[0].type != "ring")
        add_contact_grid(entries, parameters);
      entries.add("Rolling", "Normal force");
      add_road(entries, "Road", parameters.road, is_rolling_ring(bodies[0]), own.friction,
               !parameters.rolling.normal_force.empty());

      const bool steps = !own.is_event_located(), convolution = steps && own.method != "modal recursion";
      entries.add(
          section,
          "Method, Time step, End time, Friction, History interval, Checkpoint interval, Error estimate");
      entries.add_if(steps, section + "/Method is no event located", section, "Force shape");
      entries.add_if(steps && !own.friction, section + "/Method is no event located and Friction is false",
                     section, "Contact solver");
      entries.add_if(convolution, section + "/Method is a convolution", section, "Memory");
      entries.add_if(stands_under_loads(bodies[0]), "body 1 stands under a load", section, "Initial state");
      entries.add_if(own.friction, section + "/Friction is true", "Contact", "Friction coefficient");
      add_contact_solver(entries, parameters, own.friction || own.contact_solver == "common",
                         section + "/Contact solver is common");

      const std::string comparison = section + "/Comparison";
      entries.add(comparison, "Rows");
      entries.add_if(parameters.comparison.any(), "there are rows of a comparison", comparison,
                     "Repetitions");
      for (unsigned int k = 1; k < bodies.size(); ++k)
      {
        const auto further = parameters.comparison.further_bodies.find(bodies[k].name);
        if (further == parameters.comparison.further_bodies.end())
          continue;
        const std::string of_body = comparison + "/" + bodies[k].name;
        entries.add(of_body, "Rows");
        if (further->second.rows.empty())
          continue;
        entries.add_if(gives_way(bodies[k]), "its points are not rigid", of_body, "Force shape");
        add_body(entries, parameters, k, use);
        add_road(entries, of_body + "/Road", further->second.road, is_rolling_ring(bodies[k]), own.friction);
      }
    }

    void periodic_read(EntriesRead &entries, const Parameters &parameters)
    {
      const PeriodicParameters &own = parameters.periodic;
      const std::string section = "Periodic";
      const bool on_grid = own.contact_points.empty();
      BodyUse use = moving_in_contact();
      use.contact = on_grid;
      use.tangential = parameters.contact.friction > 0;
      if (parameters.scene.bodies[0].is_meshed())
        add_body(entries, parameters, 0, use);
      if (on_grid)
        add_contact_grid(entries, parameters);
      entries.add("Contact", "Friction coefficient");
      entries.add_if(own.law.empty(), "Periodic/Law is empty", "Contact", "Normal law");
      add_normal_law(entries, own.law.empty() ? parameters.contact.normal_law : own.own_law(),
                     "the normal law of Periodic or Contact");
      entries.add(section, "Trial basis, Weighting basis, Number of functions, Form, Law, Frequency, Force, "
                           "Force point, Contact points, Gap, Model, Samples, "
                           "Quadrature points, Reference, Output samples");
      entries.add_if(!on_grid || own.stop_axis().first != 2 || !own.force_point.empty() ||
                         stands_under_loads(parameters.scene.bodies[0]),
                     "there are Contact points, a Force point or a load, which tell one side from the other",
                     section, "Stop direction");
      entries.add(section + "/Comparison", "Numbers");
      entries.add_if(!own.numbers.empty(), "there are Periodic/Comparison/Numbers", section + "/Comparison",
                     "Pairs");
      entries.add_if(own.reference && !own.numbers.empty(),
                     "Periodic/Reference is true and there are Periodic/Comparison/Numbers",
                     section + "/Comparison", "Force phases");

      const BranchParameters &branch = own.continuation;
      const std::string continuation = section + "/Continuation",
                        followed = "Periodic/Continuation/Parameter is not none";
      const bool wanted = branch.is_wanted(), tells = wanted && branch.stability != "none";
      entries.add(continuation, "Parameter");
      entries.add_if(wanted, followed, continuation,
                     "First value, Last value, Start value, Scale, Largest step, Smallest step, Most points, "
                     "Location tolerance, Stability, Pairs");
      entries.add_if(wanted && !branch.parsed_pairs().empty(), "there are Periodic/Continuation/Pairs",
                     continuation, "Numbers");
      entries.add_if(tells, "Periodic/Continuation/Stability is not none", continuation, "Mode limit");
      entries.add_if(tells && branch.stability == "hill", "Periodic/Continuation/Stability is hill",
                     continuation, "Hill harmonics");
    }
  } // namespace

  EntriesRead entries_read(const std::string &analysis, const Parameters &parameters)
  {
    static const std::vector<std::pair<std::string, std::function<void(EntriesRead &, const Parameters &)>>>
        readers = {{"modes", modes_read},
                   {"frequency response", frequency_response_read},
                   {"identification", identification_read},
                   {"quasi-static rolling", rolling_read},
                   {"modal convolution", modal_convolution_read},
                   {"periodic", periodic_read},
                   {"stability", stability_read},
                   {"transient", transient_read}};
    EntriesRead entries;
    // lists and names; where results go and what is drawn of them
    entries.add("", "Title, Bodies, Analyses");
    entries.add("Output", "Directory, Cache directory, Fields, Figures");
    for (const BodyParameters &body : parameters.scene.bodies)
      entries.add(body.name, "Type");
    const auto reader = std::find_if(readers.begin(), readers.end(),
                                     [&](const auto &known) { return known.first == analysis; });
    AssertThrow(reader != readers.end(), dealii::ExcMessage("unknown analysis " + analysis));
    reader->second(entries, parameters);
    return entries;
  }
} // namespace vibrocontact
