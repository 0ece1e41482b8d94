#include <vibrocontact/analyses/periodic/make_forced_body.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/fe/dense_system.h>
#include <vibrocontact/fe/nearest_dof.h>
#include <vibrocontact/reduction/all_modes.h>
#include <vibrocontact/reduction/compute_modes.h>
#include <vibrocontact/reduction/point_reduction.h>
#include <vibrocontact/run/road_body.h>

namespace vibrocontact
{
  namespace
  {
    using Rows = std::vector<TraceRow>;

    TraceRow times(TraceRow row, const double factor)
    {
      for (auto &[dof, weight] : row)
        weight *= factor;
      return row;
    }

    TraceRow force_row(const SecondOrderSystem &system,
                       const std::pair<dealii::Point<3>, dealii::Tensor<1, 3>> &force)
    {
      TraceRow row;
      for (unsigned int d = 0; d < 3; ++d)
        if (force.second[d] != 0)
          for (const auto &[dof, weight] :
               nearest_dof(system, force.first, d, std::string("Periodic/Force point, ") + "xyz"[d]))
            row.emplace_back(dof, weight * force.second[d]);
      return row;
    }

    /// Rows of the contact points: motion towards the stop, with friction the two tangential ones behind it.
    Rows contact_rows(const Parameters &parameters, const SecondOrderSystem &system,
                      const unsigned int number, const unsigned int rows_per_point)
    {
      const auto [axis, sign] = parameters.periodic.stop_axis();
      const unsigned int directions[3] = {axis, (axis + 1) % 3, (axis + 2) % 3};
      Rows rows;
      for (const auto &[name, place] : parameters.periodic.contact_points_on(number))
        for (unsigned int a = 0; a < rows_per_point; ++a)
          rows.push_back(times(nearest_dof(system, place, directions[a], "Periodic/Contact points: " + name),
                               a == 0 ? sign : 1.));
      for (unsigned int i = 0; i < rows.size(); i += rows_per_point)
        for (unsigned int j = 0; j < i; j += rows_per_point)
          if (rows[i][0].first == rows[j][0].first)
            throw InputError("Periodic/Contact points: two of them have the same nearest node of " +
                             system.body + "; move them apart or refine the mesh.");
      if (!rows.empty())
        return rows;
      if (axis != 2)
        throw InputError("Periodic/Stop direction is " + parameters.periodic.stop_direction +
                         ", but the contact surface of " + system.body +
                         " looks along z: give Contact points.");
      // contact components: z, x, y
      const unsigned int n = system.trace.grid.n_points();
      for (unsigned int p = 0; p < n; ++p)
        for (unsigned int a = 0; a < rows_per_point; ++a)
          rows.push_back(times(system.trace.rows[contact_row(n, a, p)], a == 0 ? sign : 1.));
      return rows;
    }

    /// Contact points, and behind them the exciting force at its place or at the first of them.
    Rows all_rows(const Parameters &parameters, const SecondOrderSystem &system, const unsigned int number,
                  const unsigned int rows_per_point)
    {
      if (system.n_rigid_modes > 0)
        throw InputError(system.body +
                         " is free, but a periodic motion needs a body that is held: it would drift.");
      Rows rows = contact_rows(parameters, system, number, rows_per_point);
      const auto force = parameters.periodic.parsed_force();
      rows.push_back(force && number == 0 ? force_row(system, *force) : rows.front());
      return rows;
    }

    ForcedBody by_elements(const Parameters &parameters, BodyReduction &reduction, const unsigned int number,
                           const unsigned int rows_per_point)
    {
      const PeriodicParameters &periodic = parameters.periodic;
      const SecondOrderSystem &system = reduction.system();
      const Rows rows = all_rows(parameters, system, number, rows_per_point);
      const unsigned int n = rows.size() - 1;

      Modes modes = reduction.shapes();
      std::vector<double> damping_ratio = reduction.modal().damping_ratio;
      if (!periodic.is_reduced())
      {
        if (n_moving_dofs(system) > most_dense_dofs)
          throw InputError("Periodic/Model is finite elements, but " + system.body + " has " +
                           std::to_string(n_moving_dofs(system)) + " degrees of freedom, more than the " +
                           std::to_string(most_dense_dofs) + " that go to LAPACK: set it to reduced.");
        modes = all_modes(system, modes);
        damping_ratio = strain_energy_damping(system, modes);
      }
      const ModeParameters &damping = parameters.modes.at(parameters.scene.bodies[number].name);
      ForcedBody body{reduce_to_points(system, reduction.flexibility(), modes,
                                       damping.scaled(damping_ratio, modes.omega), rows)};
      body.relaxation = damping.stiffness_damping;
      body.force_row = n;
      body.gap.assign(n / rows_per_point, 0.);
      for (unsigned int i = 0; i < n; ++i)
        body.residual(i, i) +=
            parameters.scene.bodies[number].description->tread_compliance(i % rows_per_point > 0);
      return body;
    }

    /// A body that is known between its contact points alone: motion up becomes motion into the stop, point by point. The
    /// exciting force acts at the first of them, behind its tread.
    ForcedBody by_its_points(const PeriodicParameters &periodic, const RoadBody &own,
                             const unsigned int rows_per_point)
    {
      const unsigned int n_points = own.places.size();
      const double into_stop = periodic.stop_axis().second;
      std::vector<SignedRow> rows;
      for (unsigned int i = 0; i < n_points; ++i)
      {
        rows.push_back({i, into_stop});
        // nothing moves across the road
        if (rows_per_point > 1)
          rows.insert(rows.end(), {{n_points + i, 1.}, {i, 0.}});
      }
      rows.push_back({0, into_stop});
      ForcedBody body{with_rows(own.body, rows)};
      const unsigned int force = body.force_row = rows.size() - 1;
      for (const auto &[i, j] : {std::pair(0u, force), {force, 0u}, {force, force}})
        body.residual(i, j) -= own.tread;
      body.modal_load.resize(body.n_modes());
      body.gap = own.shapes;
      return body;
    }

    /// A body of the scene with its contact rows and, behind them, that of the exciting force; gap: how far its undeformed
    /// surface lies back.
    ForcedBody body_between_rows(const Parameters &parameters, const MeshedBodies &bodies,
                                 const std::optional<MeasuredData> &measured, const unsigned int number,
                                 const unsigned int rows_per_point)
    {
      const BodyParameters &body = parameters.scene.bodies[number];
      if (bodies[number] && !body.rolls())
        return by_elements(parameters, bodies[number]->reduction, number, rows_per_point);
      const PeriodicParameters &periodic = parameters.periodic;
      const RoadUse use = {rows_per_point > 1, parameters.road.speed,
                           1 / (periodic.frequency * periodic.n_samples)};
      ForcedBody points =
          by_its_points(periodic, road_body(parameters, bodies, measured, number, use), rows_per_point);
      if (bodies[number])
        points.relaxation = parameters.modes.at(body.name).stiffness_damping;
      return points;
    }

    /// The motion of body 1 relative to body 2; the exciting force acts on body 1.
    ForcedBody relative_to(const ForcedBody &first, const ForcedBody &second, const Scene &scene)
    {
      const std::string names = scene.bodies[0].name + " and " + scene.bodies[1].name;
      if (first.n_points() != second.n_points())
        throw InputError("The bodies " + names + " have " + std::to_string(first.n_points()) + " and " +
                         std::to_string(second.n_points()) +
                         " contact points, but each of one meets one of the other: give both as many.");
      std::vector<SignedRow> turned;
      for (unsigned int i = 0; i < second.n_contact_rows(); ++i)
        turned.push_back({i, -1.});
      turned.push_back({0, 0.});
      ForcedBody relative = first;
      static_cast<BodyInContact &>(relative) = together(first, with_rows(second, turned));
      for (unsigned int p = 0; p < relative.n_points(); ++p)
        relative.gap[p] += second.gap[p];
      return relative;
    }
  } // namespace

  ForcedBody forced_body(const Parameters &parameters, const MeshedBodies &bodies,
                         const std::optional<MeasuredData> &measured)
  {
    const unsigned int rows_per_point = parameters.contact().friction > 0 ? 3 : 1;
    ForcedBody body = body_between_rows(parameters, bodies, measured, 0, rows_per_point);
    body.rows_per_point = rows_per_point;
    if (parameters.n_vibrating() > 1)
    {
      ForcedBody second = body_between_rows(parameters, bodies, measured, 1, rows_per_point);
      second.rows_per_point = rows_per_point;
      body = relative_to(body, second, parameters.scene);
    }
    for (double &gap : body.gap)
      gap += parameters.periodic.gap;
    return body;
  }

  void check_forced_points(const Parameters &parameters, const MeshedBodies &bodies)
  {
    for (unsigned int k = 0; k < parameters.n_vibrating(); ++k)
      if (bodies[k] && !parameters.scene.bodies[k].rolls())
        all_rows(parameters, bodies[k]->reduction.system(), k, parameters.contact().friction > 0 ? 3 : 1);
  }
} // namespace vibrocontact
