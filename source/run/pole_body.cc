#include <vibrocontact/reduction/ring_poles.h>
#include <vibrocontact/response/static_load.h>
#include <vibrocontact/run/pole_body.h>
#include <vibrocontact/run/run_identification.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    PoleModel reduced_poles(const ReducedBody &body, const bool with_friction)
    {
      const unsigned int n = body.grid.n_points(), n_rows = with_friction ? 2 * n : n, m = body.omega.size();
      // the contact's x points backwards, the road's forward
      const auto sign = [n](const unsigned int row) { return row < n ? 1. : -1.; };
      DenseMatrix trace(n_rows, m), residual(n_rows, n_rows);
      for (unsigned int i = 0; i < n_rows; ++i)
      {
        for (unsigned int k = 0; k < m; ++k)
          trace(i, k) = sign(i) * body.modal_trace(i, k);
        for (unsigned int j = 0; j < n_rows; ++j)
          residual(i, j) = sign(i) * sign(j) * body.residual_flexibility(i, j);
      }
      return pole_model(body.omega, body.damping_ratio, trace, body.modal_load, residual, body.labels);
    }

    /// Data of rolling bodies are not.
    bool is_reciprocal(const PoleModel &model)
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

  PoleBody pole_body(const Parameters &parameters, const MeshedBodies &bodies,
                     const std::optional<MeasuredData> &measured, const unsigned int number,
                     const RoadParameters &road)
  {
    const BodyParameters &body = parameters.scene.bodies[number];
    const bool friction = parameters.modal_convolution.friction;
    if (body.type == "oscillator")
      return {oscillator_poles(body.oscillator, friction), {0.}, {0.}, true};
    PoleBody result;
    if (body.type == "identified")
    {
      const IdentifiedParameters &own = body.identified;
      result.poles = identified_body(parameters, measured, body);
      result.is_passive = !parameters.identification.rolling && is_reciprocal(result.poles);
      result.places = own.positions.empty() ? std::vector<double>{0.} : own.positions;
      result.shapes = own.positions.empty() ? std::vector<double>{0.} : own.heights();
      return result;
    }
    if (body.type == "ring")
    {
      for (const double angle : body.ring.angles())
      {
        result.places.push_back(body.ring.radius * angle);
        result.shapes.push_back(body.ring.radius * (1 - std::cos(angle)));
      }
      if (!body.ring.is_meshed())
      {
        // a ring that rolls forward turns backwards in its own coordinate
        const double rotation = body.ring.rolling ? -road.speed / body.ring.radius : 0;
        result.poles = ring_poles(body.ring, ring_rows(body.ring, friction), rotation);
        result.is_passive = rotation == 0;
        return result;
      }
    }
    ReducedBody reduced = bodies[number]->reduction.reduced(true);
    scale_damping(reduced, parameters.modes.at(body.name));
    if (body.type == "ring")
      result.poles = ring_poles(body.ring, reduced, friction);
    else
    {
      result.poles = reduced_poles(reduced, friction);
      for (unsigned int i = 0; i < reduced.grid.n_points(); ++i)
      {
        // the contact travels towards -x
        result.places.push_back(-reduced.grid.x(i));
        result.shapes.push_back(reduced.surface_height[i]);
      }
    }
    return result;
  }

  RoadParameters road_of(const Parameters &parameters, const PoleBody &body)
  {
    RoadParameters road = parameters.road;
    if (!parameters.rolling.normal_force.empty())
      road.indentation =
          indentation_of_load(body.poles, body.shapes, parameters.rolling.normal_force.front());
    return road;
  }
} // namespace vibrocontact
