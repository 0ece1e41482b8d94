#include <vibrocontact/analyses/periodic/make_forced_body.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/bodies/rolling_modes.h>
#include <vibrocontact/coupled_bodies/contact_pair.h>
#include <vibrocontact/fe/dense_system.h>
#include <vibrocontact/fe/nearest_dof.h>
#include <vibrocontact/reduction/all_modes.h>
#include <vibrocontact/reduction/compute_modes.h>
#include <vibrocontact/reduction/point_reduction.h>
#include <vibrocontact/run/road_body.h>

#include <algorithm>

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
      const unsigned int n = system.trace.rows.size() / 3;
      for (unsigned int p = 0; p < n; ++p)
        for (unsigned int a = 0; a < rows_per_point; ++a)
          rows.push_back(times(system.trace.rows[contact_row(n, a, p)], a == 0 ? sign : 1.));
      return rows;
    }

    /// Contact points, and behind them the exciting force at its place or at the first of them, into the stop of a body above.
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
        damping_ratio = damping_ratios(system, modes);
      }
      const ModeParameters &damping = parameters.modes.at(parameters.scene.bodies[number].name);
      ForcedBody body{reduce_to_points(system, reduction.flexibility(), modes,
                                       damping.scaled(damping_ratio, modes.omega), rows)};
      const RotationParameters &rotation = parameters.scene.bodies[number].rotation;
      if (rotation.has_coriolis())
        static_cast<BodyInContact &>(body) = rolling_modes(body, *reduction.flow(), rotation.speed);
      body.relaxation = damping.stiffness_damping;
      body.force_row = n;
      if (periodic.contact_points_on(number).empty())
        body.gap = system.trace.surface_height;
      else
        body.gap.assign(n / rows_per_point, 0.);
      for (unsigned int i = 0; i < n; ++i)
        body.residual(i, i) +=
            parameters.scene.bodies[number].description->tread_compliance(i % rows_per_point > 0);
      return body;
    }

    /// A body that is known between its contact points alone: motion up becomes motion into the stop, point by point. The
    /// exciting force acts at the first of them, behind its tread.
    /// @param backwards its points in the order of a contact, whose x points backwards
    ForcedBody by_its_points(const PeriodicParameters &periodic, const RoadBody &own,
                             const unsigned int rows_per_point, const bool backwards)
    {
      const unsigned int n_points = own.places.size();
      const double into_stop = periodic.stop_axis().second;
      std::vector<SignedRow> rows;
      for (unsigned int i = 0; i < n_points; ++i)
      {
        const unsigned int point = backwards ? n_points - 1 - i : i;
        rows.push_back({point, into_stop});
        // nothing moves across the road
        if (rows_per_point > 1)
          rows.insert(rows.end(), {{n_points + point, backwards ? -1. : 1.}, {point, 0.}});
      }
      rows.push_back(rows.front());
      ForcedBody body{with_rows(own.body, rows)};
      const unsigned int force = body.force_row = rows.size() - 1;
      for (const auto &[i, j] : {std::pair(0u, force), {force, 0u}, {force, force}})
        body.residual(i, j) -= own.tread;
      body.modal_load.resize(body.n_modes());
      body.gap = own.shapes;
      if (backwards)
        std::reverse(body.gap.begin(), body.gap.end());
      return body;
    }

    /// A body of the scene with the rows of its own contact points and, behind them, that of the exciting force; gap: height
    /// of its undeformed surface.
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
      const bool backwards = !parameters.scene.contacts.empty() || parameters.vibrating_bodies().size() > 1;
      ForcedBody points = by_its_points(periodic, road_body(parameters, bodies, measured, number, use),
                                        rows_per_point, backwards);
      if (bodies[number])
        points.relaxation = parameters.modes.at(body.name).stiffness_damping;
      return points;
    }

    /// Places of a body's contact points among those of the scene, and its side there: +1 of the first body, -1 of the second.
    PlacedContacts::Rows sides_of(const Parameters &parameters, const ForcedBody &own,
                                  const unsigned int number)
    {
      if (!parameters.scene.contacts.empty())
      {
        PlacedContacts::Rows all = parameters.placed_contacts().rows_of(number);
        all.rows.resize(own.n_points());
        return all;
      }
      PlacedContacts::Rows all;
      for (unsigned int p = 0; p < own.n_points(); ++p)
        all.rows.push_back(p);
      all.sign.assign(own.n_points(), number == 0 ? 1. : -1.);
      return all;
    }

    /// A body between the rows of all contact points of the scene: those that it has no part in do not move it.
    /// @param driven share of the exciting force that acts on it, along its own row
    BodyInContact placed(const ForcedBody &own, const PlacedContacts::Rows &sides,
                         const unsigned int n_points, const double driven)
    {
      const unsigned int per_point = own.rows_per_point;
      std::vector<SignedRow> rows(n_points * per_point, {0, 0.});
      for (unsigned int p = 0; p < own.n_points(); ++p)
        for (unsigned int a = 0; a < per_point; ++a)
          rows[sides.rows[p] * per_point + a] = {p * per_point + a, sides.sign[p]};
      rows.push_back({own.force_row, driven});
      return with_rows(own, rows);
    }

    /// Undeformed gaps, from the heights of the bodies' surfaces.
    std::vector<double> gaps(const Parameters &parameters, const std::vector<unsigned int> &numbers,
                             const std::vector<ForcedBody> &bodies, const unsigned int n_points)
    {
      std::vector<double> result(n_points, parameters.periodic.gap);
      if (!parameters.has_periodic_grid())
      {
        for (const ForcedBody &body : bodies)
          for (unsigned int p = 0; p < n_points; ++p)
            result[p] += body.gap[p];
        return result;
      }
      std::vector<ReducedBody> surfaces(parameters.scene.bodies.size());
      std::vector<ContactBody> all;
      for (const BodyParameters &body : parameters.scene.bodies)
        all.push_back({&body, nullptr});
      for (unsigned int k = 0; k < numbers.size(); ++k)
      {
        surfaces[numbers[k]].surface_height = bodies[k].gap;
        all[numbers[k]].reduced = &surfaces[numbers[k]];
      }
      const ContactInterface interface =
          contact_interface(all, parameters.contacts, parameters.placed_contacts());
      for (unsigned int p = 0; p < n_points; ++p)
        result[p] += interface.gap[p];
      return result;
    }
  } // namespace

  ForcedBody forced_body(const Parameters &parameters, const MeshedBodies &bodies,
                         const std::optional<MeasuredData> &measured)
  {
    const Scene &scene = parameters.scene;
    const std::vector<unsigned int> numbers = parameters.vibrating_bodies();
    const unsigned int rows_per_point = parameters.largest_friction() > 0 ? 3 : 1;
    std::vector<ForcedBody> own;
    for (const unsigned int number : numbers)
    {
      own.push_back(body_between_rows(parameters, bodies, measured, number, rows_per_point));
      own.back().rows_per_point = rows_per_point;
    }
    const unsigned int n_points =
        scene.contacts.empty() ? own.front().n_points() : parameters.placed_contacts().n_points();
    ForcedBody result;
    result.rows_per_point = rows_per_point;
    for (unsigned int k = 0; k < own.size(); ++k)
    {
      if (scene.contacts.empty() && own[k].n_points() != n_points)
        throw InputError("The bodies " + scene.bodies[0].name + " and " + scene.bodies[1].name + " have " +
                         std::to_string(n_points) + " and " + std::to_string(own[k].n_points()) +
                         " contact points, but each of one meets one of the other: give both as many.");
      const PlacedContacts::Rows sides = sides_of(parameters, own[k], numbers[k]);
      const double driven = k > 0 ? 0. : parameters.periodic.parsed_force() ? 1. : sides.sign[0];
      const BodyInContact between = placed(own[k], sides, n_points, driven);
      static_cast<BodyInContact &>(result) = k == 0 ? between : together(result, between);
    }
    result.force_row = n_points * rows_per_point;
    result.gap = gaps(parameters, numbers, own, n_points);
    return result;
  }

  void check_forced_points(const Parameters &parameters, const MeshedBodies &bodies)
  {
    for (const unsigned int number : parameters.vibrating_bodies())
      if (bodies[number] && !parameters.scene.bodies[number].rolls())
        all_rows(parameters, bodies[number]->reduction.system(), number,
                 parameters.largest_friction() > 0 ? 3 : 1);
  }
} // namespace vibrocontact
