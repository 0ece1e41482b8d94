#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/nearest_names.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/run/check_transient.h>

#include <algorithm>

namespace vibrocontact
{
  namespace
  {
    void check_perturbed_body(const TransientParameters &transient, const std::vector<std::string> &bodies)
    {
      if (transient.perturbed_mode.empty())
        return;
      const std::string begin = "Transient/Perturbed mode names '" + transient.perturbed_mode + "', but ",
                        body = transient.perturbed_body();
      if (bodies.empty())
        throw InputError(begin + "no body has modes: leave it out.");
      if (std::find(bodies.begin(), bodies.end(), body) == bodies.end())
        throw InputError(begin + "'" + body +
                         "' is no body with modes (write body:label, for instance wheel:axial(0,2)); " +
                         name_suggestion(body, bodies));
    }

    /// Gap and velocity at the beginning move the modes of body 1.
    void check_thrown_body(const TransientParameters &transient, const BodyParameters &body_1)
    {
      if (body_1.vibrates() || (transient.initial_gap == 0 && transient.initial_velocity == 0))
        return;
      const bool velocity = transient.initial_velocity != 0;
      throw InputError("Transient/Initial " +
                       (velocity ? "velocity is " + number_text(transient.initial_velocity) + " m/s"
                                 : "gap is " + number_text(transient.initial_gap) + " m") +
                       ", but body 1, " + body_1.name + ", is a " + body_1.type +
                       " body, which has no mass that could be thrown: list the body that moves first in "
                       "Bodies, or move it by a Hub displacement.");
    }

    /// How a body that is known at its contact points alone moves as a whole nobody knows.
    void check_body_known_by_poles(const Parameters &parameters, const BodyParameters &body_1)
    {
      const TransientParameters &transient = parameters.transient;
      if (!body_1.is_known_by_poles())
        return;
      const std::string known = ", but body 1, " + body_1.name +
                                ", is known at its contact points alone, by poles, which do not say ";
      if (transient.initial_gap != 0 || transient.initial_velocity != 0)
        throw InputError("Transient/Initial " + std::string(transient.initial_gap != 0 ? "gap" : "velocity") +
                         " is given" + known + "how it is thrown: leave it out.");
    }

    bool elements_have_mass(const Parameters &parameters)
    {
      if (parameters.transient.is_reduced())
        return false;
      for (const BodyParameters &body : parameters.scene.bodies)
        if (body.is_meshed() && !body.description->has_massless_points())
          return true;
      return false;
    }

    /// The first body whose points have mass in a contact where nothing yields; null: there is none. @param along_surface there, where
    /// no normal law yields either
    const BodyParameters *body_with_rigid_points(const Parameters &parameters,
                                                 const bool along_surface = false)
    {
      const std::vector<BodyParameters> &bodies = parameters.scene.bodies;
      for (unsigned int k = 0; k < parameters.contacts.all.size(); ++k)
      {
        const auto [above, below] = parameters.bodies_of_contact(k);
        const bool law_yields = !along_surface && !parameters.contacts.all[k].law()->is_rigid();
        if (law_yields || a_body_yields_in(parameters, k))
          continue;
        return &bodies[bodies[above].description->has_rigid_points() ? above : below];
      }
      return nullptr;
    }

    /// Whether a half-space stands for the flexibility of body b beside its modes.
    bool is_on_half_space(const Parameters &parameters, const unsigned int b)
    {
      for (unsigned int k = 0; k < parameters.contacts.all.size(); ++k)
      {
        const auto [above, below] = parameters.bodies_of_contact(k);
        if ((above == b || below == b) && !parameters.contacts.all[k].half_space_flexibility())
          return false;
      }
      return true;
    }

    /// Transient/Residual theta is for a rest that follows forces at once.
    void check_rate_of_rests(const Parameters &parameters)
    {
      if (parameters.transient.residual_theta == 1)
        return;
      const std::vector<BodyParameters> &bodies = parameters.scene.bodies;
      for (unsigned int b = 0; b < bodies.size(); ++b)
        if ((bodies[b].is_solid() || bodies[b].is_revolved()) && !bodies[b].rolls() &&
            parameters.stiffness_damping(bodies[b]) > 0 && !is_on_half_space(parameters, b))
          throw InputError("Transient/Residual theta is below 1, but " + bodies[b].name +
                           "/Modes/Stiffness damping is above 0, so that what the modes leave out follows "
                           "forces with a delay: set one of them back.");
    }

    /// Reactions of points with mass do not converge with the step.
    void check_inertia_of_contact(const Parameters &parameters)
    {
      const TransientParameters &transient = parameters.transient;
      if (!contact_points_have_mass(parameters))
      {
        const BodyParameters *const sticking = body_with_rigid_points(parameters, true);
        if (parameters.scene.runs("limit cycle") && sticking && !transient.reacts_at_end_of_step())
          throw InputError(
              "The contact of " + sticking->name + ", of type " + sticking->type +
              ", yields nowhere along its surface, where friction makes it stick: in limit cycles "
              "reactions weighted as other forces alternate there from step to step; set "
              "Transient/Reaction to end of step.");
        return;
      }
      const bool elements = elements_have_mass(parameters);
      const BodyParameters *const body = elements ? nullptr : body_with_rigid_points(parameters);
      const std::string rigid = body ? "The contact of " + body->name + ", of type " + body->type +
                                           ", yields nowhere, and its points have mass: "
                                     : "",
                        softer = body ? "give Contact/Normal law one that yields" : "set Model to reduced";
      if (!transient.reacts_at_end_of_step())
        throw InputError(
            (elements ? "Transient/Model is finite elements, whose contact points have mass: " : rigid) +
            "there reactions weighted as other forces ring with growing amplitude; set Transient/Reaction to "
            "end of step" +
            (elements ? "." : ", or " + softer + "."));
      if (transient.adapts_steps())
        throw InputError(
            (elements ? "Section Transient gives an Error tolerance, but with Model = finite elements the "
                        "contact points have mass, whose"
                      : rigid + "Section Transient gives an Error tolerance, but their") +
            std::string(" forces after an impact change from step to step however short it is: leave the "
                        "tolerance out or ") +
            softer + ".");
    }

    /// An exciting force moves a body with modes.
    void check_excited_body(const TransientParameters &transient, const BodyParameters &body_1)
    {
      if (!transient.exciting_force.empty() && !body_1.vibrates())
        throw InputError("Transient/Exciting force acts on body 1, but " + body_1.name + " is a " +
                         body_1.type +
                         " body, which it cannot move: list the body that moves first in Bodies.");
    }
    /// A march from the end of section Loading.
    void check_loaded_start(const Parameters &parameters)
    {
      const TransientParameters &transient = parameters.transient;
      if (!transient.starts_from_loading())
        return;
      const std::string is = "Transient/Initial state is quasi-static loading, but ";
      if (contact_points_have_mass(parameters))
        throw InputError(is + "the contact points have mass, whose reactions at rest are not those of the "
                              "loading: set Model to reduced, or take a contact that yields.");
      for (const BodyParameters &body : parameters.scene.bodies)
        if (body.is_periodic_rail())
          throw InputError(
              is + body.name +
              "/Rail/Model is periodic, which follows time about a rolling equilibrium: set it to "
              "solid.");
      // a table is read when all ranks are there
      check_load_over_time(transient, transient.normal_force.empty() && transient.hub_displacement.empty()
                                          ? ""
                                          : "section Transient");
      if (transient.release && !hub_kind(parameters.hub()).has_mass())
        throw InputError("Transient/Release takes the driving force off the hub, but Rolling/Hub is " +
                         parameters.hub() +
                         ", which has no mass that could spring back: set it to suspended.");
    }
  } // namespace

  bool contact_points_have_mass(const Parameters &parameters)
  {
    return elements_have_mass(parameters) || body_with_rigid_points(parameters);
  }

  bool a_body_yields_in(const Parameters &parameters, const unsigned int contact)
  {
    const std::vector<BodyParameters> &bodies = parameters.scene.bodies;
    const auto [above, below] = parameters.bodies_of_contact(contact);
    const auto yields = [](const BodyParameters &body)
    { return !body.description->has_rigid_points() && !body.description->is_rigid(); };
    return yields(bodies[above]) || (below < bodies.size() && yields(bodies[below]));
  }

  bool yields_beside_modes(const Parameters &parameters)
  {
    for (unsigned int k = 0; k < parameters.contacts.all.size(); ++k)
      if (a_body_yields_in(parameters, k))
        return true;
    return false;
  }

  void check_load_over_time(const TransientParameters &transient, const std::string &source)
  {
    if (transient.starts_from_loading() && !source.empty())
      throw InputError("Transient/Initial state is quasi-static loading, but " + source +
                       " gives a load over time, which would begin with another one: leave it out, or end "
                       "section Loading with it.");
  }

  void check_transient(const Parameters &parameters)
  {
    const TransientParameters &transient = parameters.transient;
    const RollingParameters &rolling = parameters.rolling;
    transient.check();
    if (!rolling.normal_force.empty() && !rolling.hub_displacement.empty())
      throw InputError("Rolling/Normal force and Rolling/Hub displacement are both given, but one follows "
                       "from the other: empty one of them.");
    const std::vector<BodyParameters> &bodies = parameters.scene.bodies;
    std::vector<std::string> with_modes;
    for (const BodyParameters &body : bodies)
      if (body.vibrates() && !body.is_known_by_poles())
        with_modes.push_back(body.name);
    std::sort(with_modes.begin(), with_modes.end());
    check_perturbed_body(transient, with_modes);
    check_inertia_of_contact(parameters);
    check_thrown_body(transient, bodies[0]);
    check_rate_of_rests(parameters);
    check_body_known_by_poles(parameters, bodies[0]);
    check_excited_body(transient, bodies[0]);
    check_loaded_start(parameters);
  }
} // namespace vibrocontact
