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
    bool with_poles = true;
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
        complete_reduction(*meshed, body, parameters.modes.at(body.name), with_dampers);
      if (reduced && body.is_periodic_rail())
        with_poles = reduced->n_poles() > 0;
      own[k] = body_of_contact(parameters, std::move(meshed), measured, k);
      bodies.push_back({&body, own[k] ? &*own[k] : nullptr});
    }
    PairOfCase result;
    result.pair = contact_pair(bodies, parameters.contacts, contacts);
    if (parameters.stability.is_hysteretic())
    {
      result.loss = take_hysteretic_loss(result.pair, bodies, parameters.contacts, contacts);
      result.loss->exact = exact_receptances(meshed_bodies, contacts, with_poles);
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
    // of any contact
    if (entry.substr(entry.rfind('/') + 1) == "Friction coefficient")
      return true;
    for (const char *const one :
         {"Rolling/Normal force", "Rolling/Hub displacement", "Rolling/Longitudinal creepage",
          "Rolling/Lateral creepage", "Rolling/Spin"})
      if (entry == one)
        return true;
    return false;
  }

  void ReducedOfCases::prepare(const unsigned int k, const bool with_poles)
  {
    std::vector<const ReducedBody *> of_case(bodies[k].size(), nullptr);
    for (unsigned int b = 0; b < bodies[k].size(); ++b)
      if (MeshedBody *const body = bodies[k][b].get())
      {
        if (all_reduced.count(body) == 0)
          all_reduced[body] = body->reduction.reduced(true);
        of_case[b] = &all_reduced[body];
      }
      else if (TrackBody *const track = b < bodies[k].tracks.size() ? bodies[k].tracks[b].get() : nullptr)
      {
        const auto key = std::make_pair(track, with_poles);
        if (all_tracks.count(key) == 0)
        {
          all_tracks[key] = with_poles ? track->moving() : track->at_rest();
          track->receptance(); // its elements, before ranks part
        }
        of_case[b] = &all_tracks[key];
      }
    reduced[k] = std::move(of_case);
  }

  const std::vector<const ReducedBody *> &ReducedOfCases::of(const unsigned int k) const
  {
    if (!has(k))
      throw ConvergenceError("The bodies of this case are not reduced.");
    return reduced[k];
  }
} // namespace vibrocontact
