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
#include <vibrocontact/run/check_periodic.h>
#include <vibrocontact/run/check_transient.h>
#include <vibrocontact/run/entries_of_contact.h>
#include <vibrocontact/run/parameters.h>
#include <vibrocontact/scene/identified.h>
#include <vibrocontact/scene/rail.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace vibrocontact
{
  namespace
  {
    /// a band of this size has a Schur complement of some 0.6 GB
    constexpr unsigned int most_band_points = 3000;

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

    void check_road_friction(const Parameters &parameters)
    {
      const BodyParameters &body = parameters.scene.bodies[0];
      if (!parameters.modal_convolution.friction)
      {
        bool slides = parameters.road.sliding_speed != 0;
        for (const auto &further : parameters.comparison.further_bodies)
          slides = slides || further.second.road.sliding_speed != 0;
        if (slides)
          throw InputError("Road/Sliding speed is given, but Modal convolution/Friction is false, so that "
                           "nothing feels it: set Friction to true or leave the speed out.");
        return;
      }
      const std::string entry = "Modal convolution/Friction is true, but ";
      if (body.description->measured())
        throw InputError(entry + body.name +
                         " is of type identified, whose data say nothing about motion along "
                         "the road: set it to false.");
      if (parameters.comparison.any())
        throw InputError(entry +
                         "Comparison/Rows asks for a comparison of methods, whose exact motion has none: "
                         "leave one of them out.");
    }

    /// The unreduced bodies are made and marched by all ranks together.
    template <typename Analysis>
    void check_sweep_model(const std::string &section, const Analysis &analysis)
    {
      if (!analysis.is_reduced())
        throw InputError(section + "/Model is " + analysis.model + ", but " + section +
                         "/Sweep is that of the reduced model: set it to reduced or leave the sweep out.");
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

    /// What Stability/Loss = hysteretic knows of each body.
    void check_hysteretic_loss(const Parameters &parameters)
    {
      if (!parameters.scene.runs("stability") || !parameters.stability.is_hysteretic())
        return;
      for (const BodyParameters &body : parameters.scene.bodies)
        if (parameters.stiffness_damping(body) > 0)
          throw InputError(body.name + "/Modes/Stiffness damping is viscous, beside which Stability/Loss = "
                                       "hysteretic takes no body of finite elements: leave it out, or set "
                                       "Loss to viscous.");
    }

    /// What Stability/Roots = of body 1 takes.
    void check_roots_of_body_1(const Parameters &parameters)
    {
      const BodyParameters &body = parameters.scene.bodies[0];
      const std::string is = "Stability/Roots is of body 1, ";
      if (!parameters.scene.runs("stability") || !parameters.stability.are_of_body_1())
        return;
      if (!parameters.sweeps.at("stability").any())
        throw InputError(is + "which is for variants: give them in Stability/Sweep, or set Roots to all.");
      if (parameters.stability.second_count)
        throw InputError(is + "beside which Second count would count those without dampers: leave it out.");
      if (!body.is_revolved() || body.rolls())
        throw InputError(is + "which is for a wheel with Model = harmonics that does not rotate, but " +
                         body.name + " is none: set Roots to all.");
      if (!hub_kind(parameters.rolling.hub).keeps_place || !parameters.scene.contacts.empty() ||
          parameters.sweeps.at("stability").sweeps(ParameterSweep::lateral_position))
        throw InputError(is +
                         "which takes a held hub in one contact that stays in its place: set Roots to all.");
    }

    void check_sweep(const Parameters &parameters)
    {
      const ParameterSweep &sweep = parameters.sweeps.at("stability");
      const RollingParameters::Sweep &rolling = parameters.rolling.sweep;
      parameters.stability.check();
      check_roots_of_body_1(parameters);
      if (parameters.stability.derivatives.any())
      {
        check_own_equations(parameters, "Section Stability/Derivatives has Entries");
        if (!rolling.given().empty())
          throw InputError("Stability/Derivatives are those of a single case, but Rolling/Sweep is given: "
                           "leave one of them out.");
      }
      if (!sweep.any())
        return;
      check_sweep_model("Stability", parameters.stability);
      if (parameters.stability.follows())
        check_own_equations(parameters, "Stability/Roots of a sweep is followed");
      if (!rolling.given().empty())
        throw InputError("Stability/Sweep/Entry and Rolling/Sweep are both given: leave one of them out.");
      if (!sweep.sweeps(ParameterSweep::lateral_position))
        return;
      for (const char *other : {"quasi-static rolling", "transient", "frequency response"})
        if (parameters.scene.runs(other))
          throw InputError("Stability/Sweep/Entry sweeps Contact/Lateral position on one reduction of " +
                           parameters.scene.bodies[0].name + " for all positions, which the analysis \"" +
                           other + "\" does not take: run it from a file of its own.");
      if (!parameters.scene.bodies[0].is_meshed())
        throw InputError("Stability/Sweep/Entry is Contact/Lateral position, which moves the contact on body "
                         "1, but " +
                         parameters.scene.bodies[0].name + " has no mesh: sweep another entry.");
      const ContactGrid grid = parameters.body_grid(0);
      if (grid.n_points() > most_band_points)
        throw InputError("Stability/Sweep/Range asks for a band of " + std::to_string(grid.n_x) + " x " +
                         std::to_string(grid.n_y) + " contact points on " + parameters.scene.bodies[0].name +
                         ", more than " + std::to_string(most_band_points) +
                         ": sweep a shorter range, enlarge Contact/Grid spacing or make Contact/Half length "
                         "and Half width smaller.");
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
    {
      bool any = false;
      for (const auto &[name, mode] : modes)
        any = any || mode.any();
      if (!any)
        throw InputError(modes.begin()->first +
                         "/Modes asks for no modes, nor does any other body, but the analysis "
                         "\"modes\" is listed; give Upper frequency or Count, or leave it out");
    }
    if (goes_through_loading())
    {
      check_supports(scene);
      check_loading(*this);
    }
    if (scene.runs("quasi-static rolling") || scene.runs("stability") || scene.runs("limit cycle"))
    {
      // what moves each of several contacts is asked of them
      rolling.check(!scene.contacts.empty() ||
                    (contact().friction == 0 && rolling.sweep.friction.empty() && !scene.runs("stability")));
      check_supports(scene);
      for (const ContactParameters &one : contacts.all)
      {
        if (!rolling.sweep.friction.empty() && !one.takes_coefficient())
          throw InputError("Rolling/Sweep/Friction coefficient is given, but " + one.section +
                           "/Friction law is " + one.friction_law +
                           ", which has its own coefficients: leave the sweep out or take another law.");
        // a single value left at its default is not given; used.prm of a sweep has to be valid
        if (!rolling.sweep.friction.empty() && one.friction != ContactParameters().friction)
          throw InputError(one.section +
                           "/Friction coefficient and Rolling/Sweep/Friction coefficient are both given, "
                           "but the sweep takes the place of the single value: leave one of them out.");
      }
    }
    if (rolls_or_slides(scene))
    {
      check_hub(*this);
      for (const BodyParameters &body : scene.bodies)
        check_green_body(*this, body);
    }
    if (goes_through_time())
    {
      std::vector<std::string> with_modes;
      for (const BodyParameters &body : scene.bodies)
        if (body.is_meshed() && !body.has_complex_modes())
          with_modes.push_back(body.name);
      check_transient(*this);
      if (sweeps.at("transient").any())
        check_sweep_model("Transient", transient);
      signals.check(with_modes, transient);
    }
    if (scene.runs("limit cycle"))
      check_limit_cycle(*this);
    if (scene.runs("export"))
      check_export(*this);
    if (scene.runs("frequency response"))
      check_frequency_response(*this);
    if (has_identification())
      identification.check();
    if (scene.runs("stability"))
      check_sweep(*this);
    if (scene.runs("modal convolution"))
    {
      if (!scene.bodies[0].is_green() && !scene.bodies[0].is_meshed())
        throw InputError("Analyses: a modal convolution moves body 1 by its poles, but " +
                         scene.bodies[0].name + ", " + scene.bodies[0].type +
                         ", has none: make body 1 an oscillator, a ring, an identified body or one "
                         "with elements.");
      road.check();
      modal_convolution.check();
      comparison.check();
      check_road_friction(*this);
      if (comparison.any() && !contact().law()->is_rigid())
        throw InputError(
            "Comparison/Rows asks for a comparison of methods, whose exact motion knows rigid points "
            "only, but Contact/Normal law is " +
            contact().normal_law + ": set it to signorini or leave the rows out.");
      if (!rolling.normal_force.empty() && road.indentation != 0)
        throw InputError("Rolling/Normal force and Road/Indentation are both given, but one follows from the "
                         "other: leave one of them out.");
      for (const BodyParameters &body : scene.bodies)
      {
        const auto further = comparison.further_bodies.find(body.name);
        const bool first = &body == &scene.bodies[0];
        if (!first && (further == comparison.further_bodies.end() || further->second.rows.empty()))
          continue;
        check_speed_of_road(body, first ? road : further->second.road);
      }
    }
    if (scene.runs("periodic"))
      check_periodic(*this);
    for (unsigned int k = 0; k < contacts.all.size(); ++k)
    {
      const ContactParameters &one = contacts.all[k];
      for (const unsigned int b : {bodies_of_contact(k).first, bodies_of_contact(k).second})
        if ((goes_through_time() || scene.runs("periodic")) && one.friction > 0 && b < scene.bodies.size() &&
            scene.bodies[b].description->moves_along_z_only() &&
            (b == 0 || scene.runs("periodic") || !one.name.empty()))
          throw InputError(scene.bodies[b].name + " is a " + scene.bodies[b].type +
                           ", which moves in one direction only: set " + one.section +
                           "/Friction coefficient to 0.");
    }
    for (const BodyParameters &body : scene.bodies)
      if (body.is_meshed() && !modes.at(body.name).any())
      {
        if (has_dynamics() || scene.runs("periodic"))
          throw InputError(body.name +
                           "/Modes asks for no modes, but stability, transient, limit cycle, modal "
                           "convolution and periodic move the body by "
                           "them; give Upper frequency or Count");
        if (body.rolls() && has_contact())
          throw InputError(body.name +
                           "/Modes asks for no modes, but its material, which rolls, flows through "
                           "the contact in them; give Upper frequency or Count");
      }
    if (scene.runs("stability") && std::none_of(scene.bodies.begin(), scene.bodies.end(),
                                                [](const BodyParameters &body) { return body.vibrates(); }))
      throw InputError("Analyses asks for stability, but no body has modes; leave \"stability\" out");
    if (scene.runs("stability") && stability.second_count &&
        std::any_of(scene.bodies.begin(), scene.bodies.end(),
                    [](const BodyParameters &body) { return body.is_known_by_poles(); }))
      throw InputError("Stability/Second count goes round real modes, but a body is known by poles: leave it "
                       "out.");
    if (scene.runs("stability") && stability.second_count &&
        std::any_of(contacts.all.begin(), contacts.all.end(),
                    [](const ContactParameters &one) { return one.law_of_friction()->depends_on_speed(); }))
      throw InputError(
          "Stability/Second count knows constant friction only: take the Contact/Friction law coulomb (a "
          "Static friction ratio of 1) or leave the count out.");
    check_harmonics(*this);
    check_rotations(*this);
    check_hysteretic_loss(*this);
    for (const auto &[section, model] : unreduced_models(*this))
      for (const BodyParameters &body : scene.bodies)
        if (body.description->lies_on_half_space() || body.is_green())
          throw InputError(section + "/Model is " + model + ", but " + body.name +
                           (body.is_green() ? " is of type " : " is a ") + body.type +
                           (body.is_green() ? ", which is known between its contact points alone"
                                            : ", whose contact lies on a half-space without inertia") +
                           ": set it to reduced, or make the body rigid or of solid elements.");
    if (has_contact())
    {
      // a meshed body has a dense compliance, 1.8 GB for 5,000 points; half-spaces a convolution
      const bool dense = std::any_of(scene.bodies.begin(), scene.bodies.end(),
                                     [](const BodyParameters &body) { return body.is_meshed(); });
      const PlacedContacts placed = placed_contacts();
      double n_points = 0;
      std::string points;
      for (const PlacedContact &one : placed.all)
      {
        n_points += double(one.grid.n_x) * one.grid.n_y;
        points += (points.empty() ? "" : " and ") + std::to_string(one.grid.n_x) + " x " +
                  std::to_string(one.grid.n_y);
      }
      points += " contact points";
      if (!dense && scene.runs("quasi-static rolling") && rolling.two_grids())
      {
        n_points *= 4;
        points += ", four times as many on the finer of two grids (Rolling/Grids)";
      }
      if (n_points > (dense ? 5000 : 250000))
        throw InputError(
            contact().section + "/Grid spacing asks for " + points + ", more than the " +
            (dense ? "5,000 that can be solved with a meshed body" : "250,000 that can be solved") +
            "; enlarge it or make Half length and Half width smaller");
      if (output.contact_problems && n_points > most_points_in_file)
        throw InputError("Output/Contact problems asks for files of " + points + ", more than the " +
                         std::to_string(most_points_in_file) +
                         " that a file holds; set it to false or enlarge Contact/Grid spacing");
    }
  }
} // namespace vibrocontact
