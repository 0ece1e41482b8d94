#include <vibrocontact/bodies/rolling_modes.h>
#include <vibrocontact/reduction/window.h>
#include <vibrocontact/run/entries_of_contact.h>
#include <vibrocontact/run/prepare_pair.h>
#include <vibrocontact/run/road_body.h>

namespace vibrocontact
{
  namespace
  {
    /// Material passes the contact towards +x, where theta grows.
    ReducedBody rolling_wheel(const ReducedBody &at_rest, const double speed, const double radius)
    {
      ReducedBody result = at_rest;
      static_cast<BodyInContact &>(result) = rolling_modes(at_rest, *at_rest.flow, speed / radius);
      // the residual of material that flows relaxes on its way, which is not taken
      result.relaxation = 0;
      result.flow = nullptr;
      return result;
    }
  } // namespace

  std::optional<ReducedBody> body_of_contact(const Parameters &parameters, std::optional<ReducedBody> meshed,
                                             const std::optional<MeasuredData> &measured,
                                             const unsigned int number)
  {
    const BodyParameters &body = parameters.scene.bodies[number];
    if (!body.is_green())
    {
      if (meshed && body.rolls())
        return rolling_wheel(*meshed, parameters.rolling.creepage.speed,
                             *body.axle_height(parameters.contact().lateral_position));
      return meshed;
    }
    RoadUse use;
    use.friction = largest_friction_of_cases(parameters) > 0;
    use.speed = parameters.rolling.creepage.speed;
    use.contact_step = parameters.scene.runs("transient")     ? parameters.transient.time_step
                       : parameters.scene.runs("limit cycle") ? parameters.limit_cycle.time_step
                                                              : 0;
    const RoadBody on_road = road_body(parameters, meshed ? &*meshed : nullptr, measured, number, use);
    // it is in one contact
    for (const PlacedContact &contact : parameters.placed_contacts().all)
      if (contact.above == number || contact.below == number)
        return contact_rows(on_road.body, body.name, contact.grid, on_road.shapes);
    throw dealii::ExcInternalError();
  }

  std::vector<ExactReceptance> exact_receptances(const MeshedBodies &bodies, const PlacedContacts &contacts,
                                                 const bool with_poles)
  {
    using Function = LocalPolynomials::Function;
    std::vector<ExactReceptance> result;
    for (unsigned int k = 0; k < bodies.tracks.size(); ++k)
      if (TrackBody *const track = bodies.tracks[k].get())
      {
        const PlacedContacts::Rows own = contacts.rows_of(k);
        const DenseMatrix &motions = track->motions();
        // a wheel whose tread ends has fewer points in contact than the rail, which is in one contact
        const auto contact =
            std::find_if(contacts.all.begin(), contacts.all.end(),
                         [&](const PlacedContact &one) { return one.above == k || one.below == k; });
        Assert(contact != contacts.all.end(), dealii::ExcInternalError());
        const std::vector<unsigned int> kept = window_rows(track->contact_grid(), contact->grid);
        DenseMatrix basis(3 * contacts.n_points(), motions.n());
        for (unsigned int j = 0; j < motions.n(); ++j)
          for (unsigned int i = 0; i < own.rows.size(); ++i)
            basis(own.rows[i], j) = own.sign[i] * motions(kept[i], j);
        ComplexMatrix rest =
            entries_as<std::complex<double>>(with_poles ? track->beside_poles() : track->elastic());
        const auto beside_rest = [rest](const Function &whole)
        {
          return [rest, whole](const std::complex<double> &s)
          {
            ComplexMatrix X = whole(s);
            X.add(-1., rest);
            return X;
          };
        };
        LocalPolynomials &nearby = track->nearby();
        ExactReceptance exact;
        exact.body = k + 1;
        exact.basis = basis;
        exact.at = beside_rest(track->receptance());
        exact.nearby = beside_rest([&nearby](const std::complex<double> &s) { return nearby.value(s); });
        exact.nearby_derivative = [&nearby](const std::complex<double> &s) { return nearby.derivative(s); };
        if (with_poles)
          exact.by_poles = track->by_poles();
        exact.loss = track->parameters.material_loss_factor();
        exact.up_to = track->highest_frequency();
        result.push_back(exact);
      }
    return result;
  }

  std::unique_ptr<const PreparedPair> prepare_pair(const Parameters &parameters, const MeshedBodies &bodies,
                                                   const std::optional<MeasuredData> &measured,
                                                   const bool with_modes,
                                                   const std::vector<FrequencyBand> *const in_time)
  {
    auto pair = std::make_unique<PreparedPair>();
    pair->reduced.resize(bodies.size());
    for (unsigned int k = 0; k < bodies.size(); ++k)
    {
      std::optional<ReducedBody> meshed;
      if (bodies[k])
      {
        meshed = bodies[k]->reduction.reduced(with_modes || parameters.scene.bodies[k].rolls());
        complete_reduction(*meshed, parameters.scene.bodies[k],
                           parameters.modes.at(parameters.scene.bodies[k].name));
      }
      if (k < bodies.tracks.size() && bodies.tracks[k])
        meshed = in_time      ? bodies.tracks[k]->in_time(*in_time)
                 : with_modes ? bodies.tracks[k]->moving()
                              : bodies.tracks[k]->at_rest();
      std::optional<ReducedBody> body = body_of_contact(parameters, std::move(meshed), measured, k);
      pair->bodies.push_back({&parameters.scene.bodies[k], body ? &pair->reduced[k] : nullptr});
      if (body)
        pair->reduced[k] = std::move(*body);
    }
    return pair;
  }
} // namespace vibrocontact
