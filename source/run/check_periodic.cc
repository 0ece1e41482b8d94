#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/base/parameter_text.h>
#include <vibrocontact/run/check_contacts.h>
#include <vibrocontact/run/check_periodic.h>
#include <vibrocontact/run/check_transient.h>
#include <vibrocontact/scene/identified.h>

namespace vibrocontact
{
  namespace
  {
    void check_constant_friction(const ContactParameters &contact)
    {
      if (contact.law_of_friction()->depends_on_speed())
        throw InputError(contact.section +
                         (contact.friction_law.empty() ? "/Static friction ratio is not 1"
                                                       : "/Friction law is " + contact.friction_law) +
                         ": periodic motion knows constant friction only.");
    }

    void check_law_of_periodic(const ContactParameters &contact, const PeriodicParameters &periodic)
    {
      const std::string own = periodic.own_law();
      if (!own.empty() && contact.normal_law != ContactParameters().normal_law && contact.normal_law != own)
        throw InputError("Periodic/Law is " + periodic.law + " and " + contact.section + "/Normal law is " +
                         contact.normal_law + ", but there is one stop: leave one of them out.");
    }

    /// Periodic motion of a body that is known between its own contact points alone.
    void check_periodic_points(const Parameters &parameters, const unsigned int number)
    {
      const BodyParameters &body = parameters.scene.bodies[number];
      const PeriodicParameters &periodic = parameters.periodic;
      const std::string moves = ", but " + body.name + ", of type " + body.type + ", ";
      const bool rolls = body.rolls(), by_poles = body.is_known_by_poles(),
                 friction = parameters.largest_friction() > 0;
      const bool has_points =
          number == 0 ? !periodic.contact_points.empty() : !periodic.contact_points_below.empty();
      if (has_points || (number == 0 && !periodic.force_point.empty()))
        throw InputError(std::string("Periodic/") +
                         (!has_points   ? "Force point"
                          : number == 0 ? "Contact points"
                                        : "Contact points on body 2") +
                         " is given" + moves +
                         "is touched and driven at its own contact points: leave it out.");
      if (periodic.stop_axis().first != 2)
        throw InputError("Periodic/Stop direction is " + periodic.stop_direction + moves +
                         "meets a stop below or above it: set it to -z or +z.");
      if (number == 0 && !periodic.is_reduced())
        throw InputError("Periodic/Model is finite elements" + moves +
                         (body.is_meshed() ? "rolls in the modes of its elements" : "has none") +
                         ": set it to reduced.");
      if (friction && (by_poles || !body.description->is_driven_along_stop()))
        throw InputError(
            parameters.contact().section + "/Friction coefficient is " +
            number_text(parameters.largest_friction()) + moves +
            (rolls ? "rolls: the slip of material that flows through the contact points is not known here"
             : by_poles ? "has no data about motion along the stop"
                        : "does not move along the stop, as nothing drives it there") +
            "; set it to 0.");
      if (body.description->measured() && body.description->measured()->inverse_transform)
        throw InputError(
            body.name + "/Identified/Inverse transform is true, whose Green's functions repeat themselves; a "
                        "periodic motion needs poles: leave it out.");
      if (by_poles && (periodic.reference || periodic.continuation.tells_stability()))
        throw InputError(std::string(periodic.reference ? "Periodic/Reference is true"
                                                        : "Periodic/Continuation/Stability is not none") +
                         moves + "has no real modes, which they are found from: leave it out.");
      check_speed_of_road(body, parameters.road);
    }

    /// Bodies whose flexibilities beside their modes relax at several rates go by poles.
    void check_relaxations(const Parameters &parameters)
    {
      const auto has_rest = [&](const BodyParameters &body)
      {
        return body.is_meshed() ? parameters.periodic.is_reduced() || body.description->has_massless_points()
                                : !body.description->has_rigid_points();
      };
      const BodyParameters *with_rest = nullptr;
      for (const unsigned int b : parameters.vibrating_bodies())
      {
        const BodyParameters &body = parameters.scene.bodies[b];
        if (!has_rest(body))
          continue;
        if (with_rest && parameters.stiffness_damping(*with_rest) != parameters.stiffness_damping(body) &&
            (parameters.periodic.reference || parameters.periodic.continuation.tells_stability()))
          throw InputError("The flexibilities of " + with_rest->name + " and " + body.name +
                           " beside their modes relax at two rates, " +
                           number_text(parameters.stiffness_damping(*with_rest)) + " and " +
                           number_text(parameters.stiffness_damping(body)) + " s, but " +
                           (parameters.periodic.reference ? "Periodic/Reference is true"
                                                          : "Periodic/Continuation/Stability is not none") +
                           ", which knows one: leave it out, or give both the same Modes/Stiffness damping.");
        with_rest = &body;
      }
    }

    /// A body that moves in a periodic motion.
    void check_vibrating_body(const Parameters &parameters, const unsigned int number)
    {
      const BodyParameters &body = parameters.scene.bodies[number];
      const std::string of_type = body.name + " is a " + body.type;
      if (!body.is_meshed() && !body.is_green())
        throw InputError("Analyses lists periodic, but " + of_type + ", which does not vibrate: make body " +
                         std::to_string(number + 1) +
                         " one with elements, an oscillator, a ring or an identified body" +
                         (number > 0 ? ", or a rigid stop." : "."));
      if (number > 0 && parameters.scene.contacts.empty() && body.description->touches_downwards_only())
        throw InputError("Analyses lists periodic, but body " + std::to_string(number + 1) + ", " + of_type +
                         ", which stands on what is below it: list it first in Bodies" +
                         body.description->way_to_look_up() + ".");
      if (!body.is_meshed() || body.rolls())
        check_periodic_points(parameters, number);
      if (body.description->lies_on_half_space())
        throw InputError("Analyses lists periodic, but " + of_type +
                         ", whose contact points lie on a half-space that periodic motion does not know: "
                         "make it a rail.");
      const std::string example = body.description->example_of_points();
      if (!example.empty() && parameters.scene.contacts.empty() &&
          parameters.periodic.contact_points_on(number).empty())
        throw InputError("Periodic/Contact points is empty, but " + of_type +
                         ", whose points of contact have to be named: give them, for instance "
                         "Contact points = " +
                         example);
    }
  } // namespace

  void check_periodic(const Parameters &parameters)
  {
    parameters.periodic.check();
    // an analysis beside it may have the other law
    bool rigid = false, yields = false;
    for (unsigned int k = 0; k < parameters.contacts.all.size(); ++k)
    {
      const ContactParameters &one = parameters.contacts.all[k];
      if (!parameters.scene.runs("quasi-static rolling") && !parameters.scene.runs("stability") &&
          !parameters.scene.runs("transient"))
        check_law_of_periodic(one, parameters.periodic);
      if (one.friction > 0)
        check_constant_friction(one);
      const bool is_rigid = parameters.periodic_law(k)->is_rigid();
      rigid = rigid || is_rigid;
      yields = yields || !is_rigid;
    }
    const std::vector<unsigned int> vibrating = parameters.vibrating_bodies();
    if (parameters.scene.contacts.empty() && vibrating.size() == 1 &&
        !trimmed(parameters.periodic.contact_points_below).empty())
      throw InputError("Periodic/Contact points on body 2 is given, but no body 2 vibrates: leave it out.");
    bool has_massless_node = false;
    for (const unsigned int b : vibrating)
    {
      check_vibrating_body(parameters, b);
      has_massless_node = has_massless_node || parameters.scene.bodies[b].description->has_massless_points();
    }
    check_relaxations(parameters);
    if (parameters.periodic.reference && parameters.contacts.all.size() > 1)
      throw InputError("Periodic/Reference knows one contact point, but Contacts lists " +
                       parameters.scene.contacts_entry + ": leave it out.");
    const bool tells_stability = parameters.periodic.continuation.tells_stability(),
               rubs = parameters.largest_friction() > 0;
    if (tells_stability && rubs && yields)
      throw InputError(
          "Periodic/Continuation/Stability is not computed for friction with a law that yields: set "
          "Periodic/Law to signorini, Stability to none or " +
          parameters.contact().section + "/Friction coefficient to 0.");
    for (const unsigned int b : vibrating)
      if (tells_stability && rubs && parameters.stiffness_damping(parameters.scene.bodies[b]) > 0)
        throw InputError(parameters.scene.bodies[b].name +
                         "/Modes/Stiffness damping is given, but Periodic/Continuation/Stability is not "
                         "computed for friction at points whose flexibility relaxes: leave one of them out.");
    for (unsigned int k = 0; k < parameters.contacts.all.size(); ++k)
      if (tells_stability && parameters.periodic_law(k)->is_rigid() && parameters.periodic.is_reduced() &&
          !a_body_yields_in(parameters, k))
        throw InputError(
            "Periodic/Continuation/Stability is told of motions against a rigid stop where a contact point "
            "without mass meets it, but in " +
            parameters.contacts.all[k].section +
            " nothing yields: set Stability to none, or take a normal law that yields.");
    if (tells_stability && rigid && !parameters.periodic.is_reduced() && !has_massless_node)
      throw InputError(
          "Periodic/Continuation/Stability with the rigid law needs a contact node without mass: set " +
          parameters.scene.bodies[0].name +
          "/Bar/Massless contact node to true or Periodic/Continuation/Stability to none.");
    if (parameters.periodic.reference && rubs)
      throw InputError("Periodic/Reference knows no friction: set " + parameters.contact().section +
                       "/Friction coefficient to 0 or leave it out.");
    if (parameters.periodic.reference && rigid && !parameters.periodic.is_reduced() && !has_massless_node)
      throw InputError("Periodic/Reference with the rigid law needs a contact node without mass: set " +
                       parameters.scene.bodies[0].name +
                       "/Bar/Massless contact node to true or Periodic/Law to penalty.");
  }
} // namespace vibrocontact
