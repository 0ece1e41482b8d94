#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/run/check_hub.h>

namespace vibrocontact
{
  namespace
  {
    void check_axle(const Parameters &parameters, const BodyParameters &body)
    {
      const RollingParameters &rolling = parameters.rolling;
      rolling.axle.check();
      if (rolling.suspension.mass > 0)
        throw InputError("Rolling/Suspension/Unsprung mass is set, but Rolling/Hub is axle, whose masses are "
                         "those of its wheels, of section Rolling/Axle and of its boxes: leave it out.");
      if (!body.is_revolved() || !parameters.modes.at(body.name).any())
        throw InputError("Rolling/Hub is axle, whose hubs turn, which is known of wheels by harmonics with "
                         "modes alone, but body 1, " +
                         body.name + ", is none: set its Model to harmonics, or Hub to suspended.");
    }
  } // namespace

  void check_hub(const Parameters &parameters)
  {
    const RollingParameters &rolling = parameters.rolling;
    const HubKind &hub = hub_kind(rolling.hub);
    const std::string is = "Rolling/Hub is " + hub.name;
    if (!hub.has_mass() && rolling.suspension.any())
      throw InputError("Section Rolling/Suspension carries a suspended hub or an axle, but " + is +
                       ": set it to suspended or axle, or leave the section out.");
    if (!hub.has_axle && rolling.axle.any())
      throw InputError("Section Rolling/Axle describes an axle, but " + is +
                       ": set it to axle or leave the section out.");
    if (hub.keeps_place)
      return;
    const BodyParameters &body = parameters.scene.bodies[0];
    if (!parameters.has_hub())
      throw InputError(is + ", but body 1, " + body.name +
                       ", is a half-space, which has no hub: leave the entry out.");
    if (!hub.has_mass())
      return;
    if (body.rolls() && body.is_revolved())
      throw InputError(is + ", but " + body.name +
                       "/Wheel/Rotation is true, and of a wheel that turns no hub with mass is known: set "
                       "Rotation to false, or Hub to held or massless.");
    if (body.is_known_by_poles())
      throw InputError(is + ", but body 1, " + body.name +
                       ", is known at its contact points alone, by poles, which do not say what its hub's "
                       "acceleration does to it: set it to held or massless.");
    if (hub.has_axle)
      check_axle(parameters, body);
    else if (!(rolling.suspension.mass > 0))
      throw InputError(is + ", but Rolling/Suspension/Unsprung mass is 0: give the mass of "
                            "all that moves with the hub, body 1 included, or set Hub to massless.");
    for (unsigned int d = 0; d < 3; ++d)
      if (!(rolling.suspension.stiffness[d] > 0))
        throw InputError(
            is + ", but Rolling/Suspension/Stiffness " + "xyz"[d] +
            " is 0, so that nothing keeps the hub at its place: give the stiffness of the primary "
            "suspension along " +
            "xyz"[d] + ".");
    if (parameters.scene.runs("stability") && !parameters.stability.is_reduced())
      throw InputError("Stability/Model is " + parameters.stability.model +
                       ", which knows no hub with mass: set it to reduced, or Rolling/Hub to held.");
    if (parameters.scene.runs("stability") && parameters.stability.second_count)
      throw InputError("Stability/Second count knows no hub with mass: leave it out, or set Rolling/Hub to "
                       "held.");
  }
} // namespace vibrocontact
