#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/coupled_bodies/hub.h>
#include <vibrocontact/run/check_contacts.h>
#include <vibrocontact/run/check_stability.h>

#include <algorithm>

namespace vibrocontact
{
  namespace
  {
    /// a band of this size has a Schur complement of some 0.6 GB
    constexpr unsigned int most_band_points = 3000;

    /// What Stability/Roots = of body 1 takes.
    void check_roots_of_body_1(const Parameters &parameters)
    {
      const BodyParameters &body = parameters.scene.bodies[0];
      const std::string is = "Stability/Roots is of body 1, ";
      if (!parameters.stability.are_of_body_1())
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

    /// What Stability/Loss = hysteretic knows of each body.
    void check_hysteretic_loss(const Parameters &parameters)
    {
      if (!parameters.stability.is_hysteretic())
        return;
      for (const BodyParameters &body : parameters.scene.bodies)
        if (parameters.stiffness_damping(body) > 0)
          throw InputError(body.name + "/Modes/Stiffness damping is viscous, beside which Stability/Loss = "
                                       "hysteretic takes no body of finite elements: leave it out, or set "
                                       "Loss to viscous.");
    }

    /// Its derivatives are those of a single case, by the contact's own equations.
    void check_derivatives(const Parameters &parameters)
    {
      if (!parameters.stability.derivatives.any())
        return;
      check_own_equations(parameters, "Section Stability/Derivatives has Entries");
      if (!parameters.rolling.sweep.given().empty())
        throw InputError("Stability/Derivatives are those of a single case, but Rolling/Sweep is given: "
                         "leave one of them out.");
    }

    void check_sweep(const Parameters &parameters)
    {
      const ParameterSweep &sweep = parameters.sweeps.at("stability");
      const RollingParameters::Sweep &rolling = parameters.rolling.sweep;
      if (!sweep.any())
        return;
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

    /// What Stability/Second count goes round.
    void check_second_count(const Parameters &parameters)
    {
      if (!parameters.stability.second_count)
        return;
      for (const BodyParameters &body : parameters.scene.bodies)
        if (body.is_known_by_poles())
          throw InputError("Stability/Second count goes round real modes, but " + body.name +
                           " is known by poles: leave it out.");
      for (const ContactParameters &one : parameters.contacts.all)
        if (one.law_of_friction()->depends_on_speed())
          throw InputError("Stability/Second count knows constant friction only: take the " + one.section +
                           "/Friction law coulomb (a Static friction ratio of 1) or leave the count out.");
    }
  } // namespace

  void check_stability(const Parameters &parameters)
  {
    const std::vector<BodyParameters> &bodies = parameters.scene.bodies;
    parameters.stability.check();
    check_roots_of_body_1(parameters);
    check_derivatives(parameters);
    check_sweep(parameters);
    if (std::none_of(bodies.begin(), bodies.end(),
                     [](const BodyParameters &body) { return body.vibrates(); }))
      throw InputError("Analyses asks for stability, but no body has modes; leave \"stability\" out");
    check_second_count(parameters);
    check_hysteretic_loss(parameters);
  }
} // namespace vibrocontact
