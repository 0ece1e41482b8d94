#include <vibrocontact/analyses/stability/sweep_case.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/reduction/window.h>

namespace vibrocontact
{
  PlacedContacts contacts_of_case(const SweepCase &one)
  {
    PlacedContacts contacts = one.parameters().placed_contacts();
    if (one.parameters().lateral_sweep())
      contacts.only() = one.parameters().contact_grid_at(one.lateral_position);
    return contacts;
  }

  PairOfCase pair_of_case(const SweepCase &one, const std::optional<MeasuredData> &measured,
                          const std::vector<const ReducedBody *> &reduced_bodies,
                          const MeshedBodies &meshed_bodies, const bool with_dampers)
  {
    const Parameters &parameters = one.parameters();
    const PlacedContacts contacts = contacts_of_case(one);
    const unsigned int n_bodies = parameters.scene.bodies.size();
    std::vector<std::optional<ReducedBody>> own(n_bodies);
    std::vector<ContactBody> bodies;
    for (unsigned int k = 0; k < n_bodies; ++k)
    {
      const BodyParameters &body = parameters.scene.bodies[k];
      const ReducedBody *const reduced = reduced_bodies[k];
      std::optional<ReducedBody> meshed;
      if (reduced && parameters.lateral_sweep())
      {
        double lateral = 0, height = 0;
        if (k == 0)
        {
          const double nominal = parameters.contact().lateral_position;
          lateral = one.lateral_position - nominal;
          if (const auto axle = body.axle_height(nominal))
            height = *axle - *body.axle_height(one.lateral_position);
        }
        meshed = window(*reduced, contacts.only(), lateral, height);
      }
      else if (reduced)
        meshed = *reduced;
      if (meshed && body.is_meshed())
        add_damping(*meshed, body, parameters.modes.at(body.name), with_dampers);
      own[k] = body_of_contact(parameters, std::move(meshed), measured, k);
      bodies.push_back({&body, own[k] ? &*own[k] : nullptr});
    }
    PairOfCase result;
    result.pair = contact_pair(bodies, parameters.contacts, contacts);
    if (parameters.stability.is_hysteretic())
    {
      result.loss = take_hysteretic_loss(result.pair, bodies, parameters.contacts, contacts);
      result.loss->exact = exact_receptances(meshed_bodies, contacts);
    }
    return result;
  }

  RollingParameters rolling_of_case(const SweepCase &one)
  {
    RollingParameters rolling = one.parameters().rolling;
    rolling.hub = one.parameters().hub();
    return rolling;
  }

  bool keeps_bodies(const std::string &entry)
  {
    for (const char *const one :
         {"Contact/Friction coefficient", "Rolling/Normal force", "Rolling/Hub displacement",
          "Rolling/Longitudinal creepage", "Rolling/Lateral creepage", "Rolling/Spin"})
      if (entry == one)
        return true;
    return false;
  }

  void check_own_equations(const Parameters &parameters, const std::string &what)
  {
    const auto refuse = [&](const std::string &asked)
    { throw InputError(what + ", which does not take " + asked + "."); };
    if (parameters.hub() == "suspended")
      refuse("a suspended hub: set Rolling/Hub to held or massless");
    for (const ContactParameters &contact : parameters.contacts.all)
      if (contact.law_of_friction()->depends_on_speed())
        refuse("friction that depends on the slip speed");
    for (const BodyParameters &body : parameters.scene.bodies)
    {
      if (body.is_periodic_rail())
        refuse("a periodic rail (" + body.name + ")");
      if (body.is_green() || body.rolls())
        refuse("a body known by poles (" + body.name + ")");
    }
  }

  void ReducedOfCases::prepare(const unsigned int k)
  {
    reduced[k].assign(bodies[k].size(), nullptr);
    for (unsigned int b = 0; b < bodies[k].size(); ++b)
      if (MeshedBody *const body = bodies[k][b].get())
      {
        if (all_reduced.count(body) == 0)
          all_reduced[body] = body->reduction.reduced(true);
        reduced[k][b] = &all_reduced[body];
      }
      else if (TrackBody *const track = b < bodies[k].tracks.size() ? bodies[k].tracks[b].get() : nullptr)
      {
        if (all_tracks.count(track) == 0)
        {
          all_tracks[track] = track->moving();
          track->beside_rest(); // its elements, before ranks part
        }
        reduced[k][b] = &all_tracks[track];
      }
  }
} // namespace vibrocontact
