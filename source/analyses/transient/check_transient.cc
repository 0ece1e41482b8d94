#include <vibrocontact/analyses/transient/check_transient.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/nearest_names.h>
#include <vibrocontact/base/number_text.h>

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
      if (body_1.is_meshed() || (transient.initial_gap == 0 && transient.initial_velocity == 0))
        return;
      const bool velocity = transient.initial_velocity != 0;
      throw InputError("Transient/Initial " +
                       (velocity ? "velocity is " + number_text(transient.initial_velocity) + " m/s"
                                 : "gap is " + number_text(transient.initial_gap) + " m") +
                       ", but body 1, " + body_1.name + ", is a " + body_1.type +
                       " body, which has no mass that could be thrown: list the body that moves first in "
                       "Bodies, or move it by a Hub displacement.");
    }
    /// Reactions of points with mass do not converge with the step.
    void check_inertia_of_contact(const TransientParameters &transient, const Scene &scene)
    {
      if (!contact_points_have_mass(transient, scene))
        return;
      if (transient.reaction != "end of step")
        throw InputError(
            "Transient/Model is finite elements, whose contact points have mass: there reactions "
            "weighted as other forces ring with growing amplitude; set Transient/Reaction to end "
            "of step.");
      if (transient.error_tolerance > 0)
        throw InputError("Section Transient gives an Error tolerance, but with Model = finite elements the "
                         "contact points have mass, whose forces after an impact change from step to step "
                         "however short it is: leave the tolerance out or set Model to reduced.");
    }

    /// An exciting force moves a body with modes.
    void check_excited_body(const TransientParameters &transient, const BodyParameters &body_1)
    {
      if (!transient.exciting_force.empty() && !body_1.is_meshed())
        throw InputError("Transient/Exciting force acts on body 1, but " + body_1.name + " is a " +
                         body_1.type +
                         " body, which it cannot move: list the body that moves first in Bodies.");
    }
  } // namespace

  bool contact_points_have_mass(const TransientParameters &transient, const Scene &scene)
  {
    if (transient.model != "finite elements")
      return false;
    for (const BodyParameters &body : scene.bodies)
      if (body.is_meshed() && !(body.type == "bar" && body.bar.massless_contact_node))
        return true;
    return false;
  }

  void check_transient(const TransientParameters &transient, const RollingParameters &rolling,
                       const Scene &scene, const std::vector<std::string> &with_modes)
  {
    transient.check();
    if (!rolling.normal_force.empty() && !rolling.hub_displacement.empty())
      throw InputError("Rolling/Normal force and Rolling/Hub displacement are both given, but one follows "
                       "from the other: empty one of them.");
    check_perturbed_body(transient, with_modes);
    check_inertia_of_contact(transient, scene);
    check_thrown_body(transient, scene.bodies[0]);
    check_excited_body(transient, scene.bodies[0]);
  }
} // namespace vibrocontact
