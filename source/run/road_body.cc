#include <vibrocontact/analyses/modal_convolution/static_load.h>
#include <vibrocontact/contact/creep.h>
#include <vibrocontact/coupled_bodies/contact_pair.h>
#include <vibrocontact/run/identified_body.h>
#include <vibrocontact/run/road_body.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// What falls gives back more than the contact has put in.
    bool falls(const BodyInContact &body)
    {
      for (unsigned int k = 0; k < body.n_modes(); ++k)
        if (body.omega[k] == 0 && body.modal_load[k] != 0)
          return true;
      return false;
    }

    /// Data of rolling bodies are not.
    bool is_reciprocal(const BodyInContact &model)
    {
      for (unsigned int k = 0; k < model.n_poles(); ++k)
        for (unsigned int i = 0; i < model.n_rows(); ++i)
          for (unsigned int j = 0; j < i; ++j)
          {
            const auto one = model.right(i, k) * model.left(j, k),
                       other = model.right(j, k) * model.left(i, k);
            if (std::abs(one - other) > 1e-6 * std::max(std::abs(one), std::abs(other)))
              return false;
          }
      return true;
    }
  } // namespace

  RoadBody road_body(const Parameters &parameters, const MeshedBodies &bodies,
                     const std::optional<MeasuredData> &measured, const unsigned int number,
                     const RoadUse &use)
  {
    if (!bodies[number])
      return road_body(parameters, static_cast<const ReducedBody *>(nullptr), measured, number, use);
    ReducedBody reduced = bodies[number]->reduction.reduced(true);
    complete_reduction(reduced, parameters.scene.bodies[number],
                       parameters.modes.at(parameters.scene.bodies[number].name));
    return road_body(parameters, &reduced, measured, number, use);
  }

  RoadBody road_body(const Parameters &parameters, const ReducedBody *const reduced,
                     const std::optional<MeasuredData> &measured, const unsigned int number,
                     const RoadUse &use)
  {
    const BodyParameters &body = parameters.scene.bodies[number];
    RoadBody result;
    result.tread = body.description->tread_compliance(false);
    result.places = body.description->places();
    result.shapes = body.description->heights();
    // a grid of section Contact may end with the body
    const PlacedContacts contacts = parameters.placed_contacts();
    if (number == 0 && contacts.only().of_body)
      result.at_open_sides = points_at_open_sides(contacts, parameters.contacts);
    if (body.description->measured())
    {
      result.body = identified_body(parameters, measured, body, use.contact_step);
      result.is_passive = !parameters.identification.rolling && is_reciprocal(result.body);
      return result;
    }
    const std::vector<double> upstream =
        use.friction ? find_creep_scheme(parameters.contact().creep_scheme).coefficients
                     : std::vector<double>();
    if (const PointBody *const points = body.description->at_points())
    {
      result.body = points->between_points(use.friction, use.speed, upstream);
      result.is_passive = !body.rolls();
      return result;
    }
    result.body = body.description->on_road(*reduced, use.friction, use.speed, upstream);
    if (!body.is_green())
    {
      result.places = places_on_road(parameters);
      result.shapes = reduced->surface_height;
      if (!parameters.scene.contacts.empty())
      {
        // above what lies below it in each contact
        std::vector<ContactBody> bodies;
        for (const BodyParameters &one : parameters.scene.bodies)
          bodies.push_back({&one, &one == &body ? reduced : nullptr});
        result.shapes = contact_interface(bodies, parameters.contacts, contacts).gap;
      }
      for (unsigned int i = 0; i < result.shapes.size(); ++i)
        result.shapes[i] += reduced->residual_load[i];
    }
    result.is_passive = !body.rolls() && !falls(result.body);
    return result;
  }

  std::vector<double> places_on_road(const Parameters &parameters)
  {
    std::vector<double> places;
    for (const PlacedContact &contact : parameters.placed_contacts().all)
      for (unsigned int i = 0; i < contact.grid.n_points(); ++i)
        // the contact travels towards -x
        places.push_back(-(contact.frame.origin[0] + contact.grid.x(i)));
    return places;
  }

  RoadLaws road_laws(const Parameters &parameters)
  {
    const PlacedContacts contacts = parameters.placed_contacts();
    RoadLaws laws;
    laws.normal = normal_law_of_points(parameters.contacts, contacts);
    if (parameters.modal_convolution.friction)
      laws.friction = friction_law_of_points(parameters.contacts, contacts);
    return laws;
  }

  RoadParameters road_of(const Parameters &parameters, const RoadBody &body)
  {
    RoadParameters road = parameters.road;
    if (!parameters.rolling.normal_force.empty())
      road.indentation = indentation_of_load(by_poles(body.body), body.shapes,
                                             parameters.rolling.normal_force.front(), road_laws(parameters));
    return road;
  }
} // namespace vibrocontact
