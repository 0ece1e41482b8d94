#include <vibrocontact/analyses/limit_cycle/check_limit_cycle.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/coupled_bodies/rolling_parameters.h>
#include <vibrocontact/marching/transient_checkpoint.h>

#include <algorithm>

namespace vibrocontact
{
  void check_limit_cycle(const Parameters &parameters)
  {
    const std::string lists = "Analyses lists limit cycle";
    const std::vector<BodyParameters> &bodies = parameters.scene.bodies;
    if (std::none_of(bodies.begin(), bodies.end(),
                     [](const BodyParameters &body) { return body.vibrates(); }))
      throw InputError(lists + ", but no body has modes: leave it out.");
    if (!(parameters.largest_friction() > 0))
      throw InputError(lists + ", but Contact/Friction coefficient is 0, so that nothing slides or sticks: "
                               "give a friction coefficient.");
    const std::string but = lists + ", which does not take ";
    if (hub_kind(parameters.hub()).has_mass())
      throw InputError(but + "a hub with mass: set Rolling/Hub to held or massless.");
    for (const ContactParameters &contact : parameters.contacts.all)
      if (contact.law_of_friction()->jump() > 0)
        throw InputError(but + "friction that falls at once from rest to sliding, as that of " +
                         contact.section + " does: let it fall over the slip speed.");
    const LimitCycleParameters &own = parameters.limit_cycle;
    if (own.starts_from_transient() && own.transient_folder.empty())
    {
      const std::string asked = "Limit cycle/Start is end of transient, but ";
      if (!parameters.scene.runs("transient"))
        throw InputError(asked +
                         "Analyses lists no transient and Limit cycle/Transient folder is empty: give one "
                         "of both.");
      if (parameters.sweeps.at("transient").any())
        throw InputError(asked + "Transient/Sweep asks for cases, so that there is no transient of the file "
                                 "itself: give Limit cycle/Transient folder, or leave the sweep out.");
      if (!parameters.transient.is_reduced())
        throw InputError(asked + "Transient/Model is finite elements, whose motion has no modes: set it to "
                                 "reduced.");
      if (parameters.sweeps.at("limit cycle").any())
        throw InputError(asked + "the cases of Limit cycle/Sweep have no transient of their own: give "
                                 "Limit cycle/Transient folder.");
    }
    if (own.starts_from_transient() && !own.transient_folder.empty())
      check_end_of_transient(own.transient_folder, "Limit cycle/Transient folder");
    if (own.basins.any() && own.n_multipliers == 0)
      throw InputError(
          "Limit cycle/Basins/Starts asks which cycle wins, but Limit cycle/Multipliers is 0, so that it "
          "is not known which of them are stable: ask for some.");
    if (own.starts_from_transient() && own.basins.any())
      throw InputError(
          "Limit cycle/Basins/Starts asks for motions between cycles, but Limit cycle/Start is end of "
          "transient, which leads to one cycle: set it to roots, or leave the Basins out.");
    if (own.basins.any() && own.roots.size() == 1)
      throw InputError(
          "Limit cycle/Basins/Starts asks for motions between cycles, but Limit cycle/Roots has one "
          "root alone, which leads to one cycle: give another, or leave Roots empty for all.");
    const CycleBranchParameters &branch = parameters.limit_cycle.branch;
    branch.check(rolling_cases(parameters.rolling, parameters.contacts).front());
    const ParameterSweep &sweep = parameters.sweeps.at("limit cycle");
    const std::vector<std::string> swept = moved_entries({sweep.first.entry, sweep.second.entry});
    if (branch.any() && std::count(swept.begin(), swept.end(), branch.entry) > 0)
      throw InputError("Limit cycle/Branch/Entry and Limit cycle/Sweep both move " + branch.entry +
                       ": follow it or sweep it.");
    for (const BodyParameters &body : bodies)
      if (branch.any() && body.is_periodic_rail())
        throw InputError(
            "Limit cycle/Branch/Entry is " + branch.entry + ", but the poles of the periodic rail " +
            body.name +
            " follow it about the roots of one equilibrium alone: leave the branch out, or set its Model "
            "to solid.");
      else if (branch.entry == "Rolling/Speed" && (body.rolls() || body.is_green()))
        throw InputError(
            "Limit cycle/Branch/Entry is Rolling/Speed, but " + body.name +
            " is made for one speed, and a branch leaves bodies as they are: sweep the speed (Limit "
            "cycle/Sweep).");
    if (branch.any() && branch.is_friction())
      for (const ContactParameters &contact : parameters.contacts.all)
      {
        if (!contact.takes_coefficient())
          throw InputError("Limit cycle/Branch/Entry is " + branch.entry + ", but the friction law of " +
                           contact.section + " is not scaled by it: follow another entry.");
        if (contact.friction != parameters.contact().friction)
          throw InputError("Limit cycle/Branch/Entry is " + branch.entry + ", but " + contact.section +
                           " has another one than " + parameters.contact().section +
                           ": give both the same, or follow another entry.");
      }
    for (const BodyParameters &body : bodies)
      if (parameters.stiffness_damping(body) > 0)
        throw InputError(body.name +
                         "/Modes/Stiffness damping is above 0, but in limit cycles what the modes leave "
                         "out follows forces at once: set it to 0.");
  }
} // namespace vibrocontact
