#include <vibrocontact/analyses/modal_convolution/static_load.h>
#include <vibrocontact/bodies/ring_poles.h>
#include <vibrocontact/bodies/road_rows.h>
#include <vibrocontact/contact/creep.h>
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
    scale_damping(reduced, parameters.modes.at(parameters.scene.bodies[number].name));
    return road_body(parameters, &reduced, measured, number, use);
  }

  RoadBody road_body(const Parameters &parameters, const ReducedBody *const reduced,
                     const std::optional<MeasuredData> &measured, const unsigned int number,
                     const RoadUse &use)
  {
    const BodyParameters &body = parameters.scene.bodies[number];
    if (body.type == "oscillator")
      return {oscillator_body(body.oscillator, use.friction), {0.}, {0.}};
    RoadBody result;
    if (body.type == "identified")
    {
      const IdentifiedParameters &own = body.identified;
      result.body = identified_body(parameters, measured, body, use.contact_step);
      result.tread = own.tread_stiffness > 0 ? 1 / own.tread_stiffness : 0.;
      result.is_passive = !parameters.identification.rolling && is_reciprocal(result.body);
      result.places = own.positions.empty() ? std::vector<double>{0.} : own.positions;
      result.shapes = own.positions.empty() ? std::vector<double>{0.} : own.heights();
      return result;
    }
    if (body.type == "ring")
    {
      result.tread = tread_compliance(body.ring, false);
      for (const double angle : body.ring.angles())
      {
        result.places.push_back(body.ring.radius * angle);
        result.shapes.push_back(body.ring.radius * (1 - std::cos(angle)));
      }
      if (!body.ring.is_meshed())
      {
        const double rotation = body.ring.rotation(use.speed);
        const std::vector<RingRow> rows = ring_rows(body.ring, use.friction);
        result.body = rotation == 0 ? ring_modes(body.ring, rows) : ring_poles(body.ring, rows, rotation);
        if (rotation != 0 && use.friction)
          add_gradient(result.body, body.ring, rotation,
                       find_creep_scheme(parameters.contact().creep_scheme).coefficients);
        result.is_passive = rotation == 0;
        return result;
      }
    }
    if (body.type == "ring")
      result.body = ring_of_elements(body.ring, *reduced, use.friction);
    else
    {
      result.body = road_rows(*reduced, use.friction, -1);
      for (unsigned int i = 0; i < reduced->grid.n_points(); ++i)
      {
        // the contact travels towards -x
        result.places.push_back(-reduced->grid.x(i));
        result.shapes.push_back(reduced->surface_height[i]);
      }
    }
    result.is_passive = !falls(result.body);
    return result;
  }

  RoadLaws road_laws(const Parameters &parameters)
  {
    return {parameters.contact().law(),
            parameters.modal_convolution.friction ? parameters.contact().law_of_friction() : nullptr};
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
