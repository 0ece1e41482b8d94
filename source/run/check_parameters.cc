#include <vibrocontact/analyses/limit_cycle/check_limit_cycle.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/base/parameter_text.h>
#include <vibrocontact/contact/problem_file.h>
#include <vibrocontact/reduction/window.h>
#include <vibrocontact/run/check_contacts.h>
#include <vibrocontact/run/check_export.h>
#include <vibrocontact/run/check_frequency_response.h>
#include <vibrocontact/run/check_hub.h>
#include <vibrocontact/run/check_loading.h>
#include <vibrocontact/run/check_modal_convolution.h>
#include <vibrocontact/run/check_periodic.h>
#include <vibrocontact/run/check_stability.h>
#include <vibrocontact/run/check_transient.h>
#include <vibrocontact/run/entries_of_contact.h>
#include <vibrocontact/run/parameters.h>
#include <vibrocontact/scene/identified.h>
#include <vibrocontact/scene/rail.h>

#include <algorithm>

namespace vibrocontact
{
  namespace
  {
    /// The static response of a body that nothing holds is infinite.
    void check_supports(const Scene &scene)
    {
      const std::string free = ", so that the body is free to move under the contact force; ";
      for (const BodyParameters &body : scene.bodies)
      {
        const auto [empty, advice] = body.description->missing_support(body.name);
        if (!empty.empty())
          throw InputError(empty + free + advice);
      }
    }

    /// A body that is known between its own points alone, in contact with another one.
    void check_green_body(const Parameters &parameters, const BodyParameters &body)
    {
      const double speed = parameters.rolling.creepage.speed;
      if (body.rolls() && speed == 0)
        throw InputError(body.name + "/" + body.body_type().section +
                         (body.is_revolved() ? "/Rotation" : "/Rolling") +
                         " is true, but Rolling/Speed is 0: give the speed that it turns with.");
      const IdentifiedParameters *const measured = body.description->measured();
      if (!measured)
        return;
      if (measured->inverse_transform)
        throw InputError(body.name +
                         "/Identified/Inverse transform is true, whose Green's functions repeat themselves; "
                         "other analyses than modal convolution need poles: leave it out.");
      if (largest_friction_of_cases(parameters) > 0)
        throw InputError(
            "Contact/Friction coefficient is " + number_text(largest_friction_of_cases(parameters)) +
            ", but " + body.name +
            " is of type identified, whose data say nothing about motion along the contact: set it "
            "to 0.");
      if (!measured->is_even() && speed > 0)
        throw InputError(body.name +
                         "/Identified/Positions are not evenly spaced, but Rolling/Speed is above 0, and "
                         "material that flows through them is differenced from point to point: set it to 0.");
    }

    void check_periodic_rails(const Parameters &parameters)
    {
      // modes are those of the other bodies
      const std::vector<std::string> taken = {"modes",      "frequency response", "quasi-static rolling",
                                              "stability",  "transient",          "quasi-static loading",
                                              "limit cycle"};
      for (const BodyParameters &body : parameters.scene.bodies)
      {
        if (!body.is_periodic_rail())
          continue;
        for (const std::string &analysis : parameters.scene.analyses)
          if (std::count(taken.begin(), taken.end(), analysis) == 0)
            throw InputError(body.name + "/Rail/Model is periodic, which the analysis \"" + analysis +
                             "\" does not take; set it to solid or leave the analysis out.");
        for (const ContactParameters &one : parameters.contacts.all)
          if (parameters.has_contact() && one.has_consistent_quadrature())
            throw InputError(one.section + "/Quadrature is consistent, but " + body.name +
                             "/Rail/Model is periodic, which knows tractions that are constant on each cell "
                             "only: set it to lumped.");
        const bool in_time = parameters.goes_through_time(),
                   by_poles = in_time || !parameters.stability.is_hysteretic();
        for (const auto &[analysis, sweep] : parameters.sweeps)
          if (by_poles && sweep.any() &&
              (analysis == "stability" || analysis == "transient" || analysis == "limit cycle"))
            throw InputError(body.name +
                             "/Rail/Model is periodic, which a sweep takes in stability with "
                             "Stability/Loss = hysteretic alone, but the analysis " +
                             analysis + " sweeps " + sweep.first.entry +
                             ": set it to hysteretic and leave "
                             "analyses in time (transient, limit cycle) out, or set Model to solid.");
        if (in_time && parameters.rolling.normal_force.empty() && parameters.rolling.hub_displacement.empty())
          throw InputError(body.name +
                           "/Rail/Model is periodic, whose poles in time follow it about the roots of a "
                           "rolling equilibrium: give Rolling/Normal force or Rolling/Hub displacement.");
        // the contact's own equations, in which its roots are sought, know no more
        if (parameters.scene.runs("stability") || in_time)
        {
          for (const BodyParameters &other : parameters.scene.bodies)
            if (other.description->measured())
              throw InputError(body.name +
                               "/Rail/Model is periodic, beside which stability and time take no identified "
                               "body, but " +
                               other.name + " is one: set Model to solid.");
          for (const ContactParameters &one : parameters.contacts.all)
            if (one.law_of_friction()->depends_on_speed())
              throw InputError(
                  body.name +
                  "/Rail/Model is periodic, beside which stability and time take constant friction "
                  "only: take the Contact/Friction law coulomb (a Static friction ratio of "
                  "1) or set Model to solid.");
        }
        for (const auto &[section, model] : unreduced_models(parameters))
          throw InputError(body.name + "/Rail/Model is periodic, but " + section + "/Model = " + model +
                           " needs elements of the whole body: set it to solid.");
      }
    }

    /// What needs elements of the whole body.
    void check_harmonics(const Parameters &parameters)
    {
      std::vector<std::string> needs;
      if (parameters.scene.runs("periodic"))
        needs.push_back("the analysis periodic");
      for (const auto &[section, model] : unreduced_models(parameters))
        needs.push_back(section + "/Model = " + model);
      for (const BodyParameters &body : parameters.scene.bodies)
      {
        if (!body.is_revolved())
          continue;
        if (!needs.empty())
          throw InputError(body.name + "/" + body.body_type().section + "/Model is harmonics, but " +
                           needs.front() + " needs elements of the whole body: set it to solid.");
      }
    }

    /// A body that turns steadily, and what it touches, are seen in axes that turn with it.
    void check_rotations(const Parameters &parameters)
    {
      for (const BodyParameters &body : parameters.scene.bodies)
      {
        const RotationParameters &rotation = body.rotation;
        const std::string section = body.name + "/Rotation";
        if (!rotation.turns())
          continue;
        for (const BodyParameters &other : parameters.scene.bodies)
          if (parameters.has_contact() && other.vibrates() && !rotation.is_same_as(other.rotation))
            throw InputError(section + "/Speed is " + number_text(rotation.speed) + " rad/s, but " +
                             other.name +
                             ", which it may touch, vibrates and does not turn with it, about the same axis: "
                             "give both the same section Rotation, or make " +
                             other.name + " rigid or a half-space.");
        if (std::any_of(parameters.contacts.all.begin(), parameters.contacts.all.end(),
                        [](const ContactParameters &one) { return one.lateral_position != 0; }))
          throw InputError(section + "/Speed is not 0 beside a Contact/Lateral position, by which the body, "
                                     "and not its axis, would be shifted: set one of them to 0.");
        if (parameters.scene.runs("periodic") && parameters.largest_friction() > 0)
          throw InputError(section + "/Speed is not 0, but there is friction: periodic motion does not know "
                                     "how fast the body slides past what it touches; set the friction "
                                     "coefficient to 0.");
        if (!rotation.has_coriolis())
          continue;
        const std::string forces = section + "/Coriolis is true, but ",
                          advice = "; set it to false, or leave that out.";
        for (const auto &[of_analysis, model] : unreduced_models(parameters))
          throw InputError(forces + of_analysis + "/Model is " + model +
                           ", which knows symmetric matrices alone" + advice);
        if (parameters.scene.runs("stability") && parameters.stability.is_hysteretic())
          throw InputError(
              forces + "Stability/Loss is hysteretic, which poles, whose damping is viscous, do not have" +
              advice);
        if (parameters.scene.runs("periodic") && !parameters.periodic.is_reduced())
          throw InputError(forces + "Periodic/Model is finite elements, which go by real modes" + advice);
        if (parameters.scene.runs("periodic") &&
            (parameters.periodic.reference || parameters.periodic.continuation.tells_stability()))
          throw InputError(forces +
                           (parameters.periodic.reference ? "Periodic/Reference is true"
                                                          : "Periodic/Continuation/Stability is not none") +
                           ", which is found from real modes" + advice);
      }
    }

    /// What the analysis modes is asked for.
    void check_asked_modes(const Parameters &parameters)
    {
      if (std::none_of(parameters.modes.begin(), parameters.modes.end(),
                       [](const auto &of_body) { return of_body.second.any(); }))
        throw InputError(parameters.modes.begin()->first +
                         "/Modes asks for no modes, nor does any other body, but the analysis "
                         "\"modes\" is listed; give Upper frequency or Count, or leave it out");
    }

    /// What section Rolling asks for, and its sweep over the friction.
    void check_rolling(const Parameters &parameters)
    {
      const Scene &scene = parameters.scene;
      const RollingParameters &rolling = parameters.rolling;
      // what moves each of several contacts is asked of them
      rolling.check(!scene.contacts.empty() || (parameters.contact().friction == 0 &&
                                                rolling.sweep.friction.empty() && !scene.runs("stability")));
      check_supports(scene);
      if (rolling.sweep.friction.empty())
        return;
      for (const ContactParameters &one : parameters.contacts.all)
      {
        if (!one.takes_coefficient())
          throw InputError("Rolling/Sweep/Friction coefficient is given, but " + one.section +
                           "/Friction law is " + one.friction_law +
                           ", which has its own coefficients: leave the sweep out or take another law.");
        // a single value left at its default is not given; used.prm of a sweep has to be valid
        if (one.friction != ContactParameters().friction)
          throw InputError(one.section +
                           "/Friction coefficient and Rolling/Sweep/Friction coefficient are both given, "
                           "but the sweep takes the place of the single value: leave one of them out.");
      }
    }

    /// What the transient and limit cycles read.
    void check_motion_in_time(const Parameters &parameters)
    {
      std::vector<std::string> with_modes;
      for (const BodyParameters &body : parameters.scene.bodies)
        if (body.is_meshed() && !body.has_complex_modes())
          with_modes.push_back(body.name);
      check_transient(parameters);
      parameters.signals.check(with_modes, parameters.transient);
    }

    /// A body that moves along the normal only has no friction.
    void check_one_way_bodies(const Parameters &parameters)
    {
      const std::vector<BodyParameters> &bodies = parameters.scene.bodies;
      const bool periodic = parameters.scene.runs("periodic");
      if (!parameters.goes_through_time() && !periodic)
        return;
      for (unsigned int k = 0; k < parameters.contacts.all.size(); ++k)
      {
        const ContactParameters &one = parameters.contacts.all[k];
        for (const unsigned int b :
             {parameters.bodies_of_contact(k).first, parameters.bodies_of_contact(k).second})
          if (one.friction > 0 && b < bodies.size() && bodies[b].description->moves_along_z_only() &&
              (b == 0 || periodic || !one.name.empty()))
            throw InputError(bodies[b].name + " is a " + bodies[b].type +
                             ", which moves in one direction only: set " + one.section +
                             "/Friction coefficient to 0.");
      }
    }

    /// Bodies of elements move in modes, which have to be asked for.
    void check_modes_of_moving_bodies(const Parameters &parameters)
    {
      for (const BodyParameters &body : parameters.scene.bodies)
        if (body.is_meshed() && !parameters.modes.at(body.name).any())
        {
          if (parameters.has_dynamics() || parameters.scene.runs("periodic"))
            throw InputError(body.name +
                             "/Modes asks for no modes, but stability, transient, limit cycle, modal "
                             "convolution and periodic move the body by "
                             "them; give Upper frequency or Count");
          if (body.rolls() && parameters.has_contact())
            throw InputError(body.name +
                             "/Modes asks for no modes, but its material, which rolls, flows through "
                             "the contact in them; give Upper frequency or Count");
        }
    }

    /// What moves with all dofs of its elements.
    void check_unreduced_models(const Parameters &parameters)
    {
      for (const auto &[section, model] : unreduced_models(parameters))
      {
        // the bodies are made and marched by all ranks together
        for (const AnalysisType &type : parameters.scene.known_analyses)
          if (type.sweep_section == section && parameters.sweeps.at(type.name).any())
            throw InputError(
                section + "/Model is " + model + ", but " + section +
                "/Sweep is that of the reduced model: set it to reduced or leave the sweep out.");
        for (const BodyParameters &body : parameters.scene.bodies)
          if (body.description->lies_on_half_space() || body.is_green())
            throw InputError(section + "/Model is " + model + ", but " + body.name +
                             (body.is_green() ? " is of type " : " is a ") + body.type +
                             (body.is_green() ? ", which is known between its contact points alone"
                                              : ", whose contact lies on a half-space without inertia") +
                             ": set it to reduced, or make the body rigid or of solid elements.");
      }
    }

    /// A meshed body has a dense compliance, 1.8 GB for 5,000 points; half-spaces a convolution.
    void check_number_of_contact_points(const Parameters &parameters)
    {
      const bool dense = std::any_of(parameters.scene.bodies.begin(), parameters.scene.bodies.end(),
                                     [](const BodyParameters &body) { return body.is_meshed(); });
      double n_points = 0;
      std::string points;
      for (const PlacedContact &one : parameters.placed_contacts().all)
      {
        n_points += double(one.grid.n_x) * one.grid.n_y;
        points += (points.empty() ? "" : " and ") + std::to_string(one.grid.n_x) + " x " +
                  std::to_string(one.grid.n_y);
      }
      points += " contact points";
      if (!dense && parameters.scene.runs("quasi-static rolling") && parameters.rolling.two_grids())
      {
        n_points *= 4;
        points += ", four times as many on the finer of two grids (Rolling/Grids)";
      }
      if (n_points > (dense ? 5000 : 250000))
        throw InputError(
            parameters.contact().section + "/Grid spacing asks for " + points + ", more than the " +
            (dense ? "5,000 that can be solved with a meshed body" : "250,000 that can be solved") +
            "; enlarge it or make Half length and Half width smaller");
      if (parameters.output.contact_problems && n_points > most_points_in_file)
        throw InputError("Output/Contact problems asks for files of " + points + ", more than the " +
                         std::to_string(most_points_in_file) +
                         " that a file holds; set it to false or enlarge Contact/Grid spacing");
    }
  } // namespace

  void Parameters::check() const
  {
    scene.check();
    check_periodic_rails(*this);
    check_contacts(*this);
    for (const auto &[name, mode] : modes)
      mode.check(name + "/Modes");
    for (const auto &[name, solver] : stiffness_solvers)
      if (solver.named() == StiffnessSolver::iterative && modes.at(name).upper_frequency > 0)
        throw InputError(
            name + "/Solver/Method is iterative, which has no factors to count the modes below " + name +
            "/Modes/Upper frequency with: set that to 0 and give a Count, or take Method = direct.");
    for (const AnalysisType &type : scene.known_analyses)
      if (scene.runs(type.name) && !type.sweep_section.empty())
        sweeps.at(type.name).check(type.sweep_section);
    if (scene.runs("modes"))
      check_asked_modes(*this);
    if (goes_through_loading())
    {
      check_supports(scene);
      check_loading(*this);
    }
    if (scene.runs("quasi-static rolling") || scene.runs("stability") || scene.runs("limit cycle"))
      check_rolling(*this);
    if (rolls_or_slides(scene))
    {
      check_hub(*this);
      for (const BodyParameters &body : scene.bodies)
        check_green_body(*this, body);
    }
    if (goes_through_time())
      check_motion_in_time(*this);
    if (scene.runs("limit cycle"))
      check_limit_cycle(*this);
    if (scene.runs("export"))
      check_export(*this);
    if (scene.runs("frequency response"))
      check_frequency_response(*this);
    if (has_identification())
      identification.check();
    if (scene.runs("stability"))
      check_stability(*this);
    if (scene.runs("modal convolution"))
      check_modal_convolution(*this);
    if (scene.runs("periodic"))
      check_periodic(*this);
    check_one_way_bodies(*this);
    check_modes_of_moving_bodies(*this);
    check_harmonics(*this);
    check_rotations(*this);
    check_unreduced_models(*this);
    if (has_contact())
      check_number_of_contact_points(*this);
  }
} // namespace vibrocontact
