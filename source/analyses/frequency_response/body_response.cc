#include <vibrocontact/analyses/frequency_response/body_response.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/fe/nearest_dof.h>
#include <vibrocontact/fe/trace_assembly.h>
#include <vibrocontact/reduction/reduction_cache.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>
#include <deal.II/base/timer.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace vibrocontact
{
  namespace
  {
    using Rows = std::vector<TraceRow>;

    /// How the points move with the dofs of the body.
    Rows response_rows(MeshedBody &body, const FrequencyResponseParameters &parameters)
    {
      const BodyParameters &own = body.parameters;
      Rows rows;
      for (const ResponsePoint &point : parameters.parsed_points())
        if (point.z)
        {
          const unsigned int directions[3] = {2, 0, 1};
          rows.push_back(nearest_dof(body.reduction.system(), {point.x, point.y, *point.z},
                                     directions[point.component],
                                     "Frequency response/Points: " + point.name));
        }
        else if (own.is_solid())
        {
          ContactGrid patch;
          patch.n_x = patch.n_y = 1;
          patch.x_first = point.x;
          patch.y_first = point.y;
          patch.spacing_x = parameters.load_length;
          patch.spacing_y = parameters.load_width;
          rows.push_back(make_contact_trace(body.elastic_body(), patch).rows[point.component]);
        }
        else
        {
          const std::vector<TraceRow> surface =
              own.description->surface_rows(own.name, point.x, point.y, parameters.load_length);
          if (surface.empty())
            throw InputError("Frequency response/Points: " + own.name + " has no surface for the point " +
                             point.name + "; give it as name: x, y, z, direction.");
          rows.push_back(surface[point.component]);
        }
      return rows;
    }

    /// The points as the cache knows them.
    std::string points_key(const FrequencyResponseParameters &parameters)
    {
      std::ostringstream key;
      key.precision(17);
      for (const ResponsePoint &point : parameters.parsed_points())
        key << "point " << point.x << " " << point.y << " " << (point.z ? *point.z : 0.) << " "
            << bool(point.z) << " " << point.component << "\n";
      key << "load " << parameters.load_length << " " << parameters.load_width << "\n";
      return key.str();
    }

    std::vector<Receptance> receptances(const DirectResponse &direct)
    {
      std::vector<Receptance> result(direct.frequency.size(), Receptance(direct.real.n()));
      for (unsigned int k = 0; k < result.size(); ++k)
        for (unsigned int i = 0; i < direct.real.n(); ++i)
          result[k][i] = {direct.real(k, i), direct.imaginary(k, i)};
      return result;
    }

    /// The same of a body of revolution.
    std::vector<RevolvedPoint> revolved_points(MeshedBody &body,
                                               const FrequencyResponseParameters &parameters)
    {
      const RevolvedSection &elements = body.reduction.revolved().elements();
      const RevolvedMesh &mesh = body.section();
      std::vector<RevolvedPoint> result;
      for (const ResponsePoint &point : parameters.parsed_points())
      {
        RevolvedPoint own;
        own.component = point.component;
        const std::string what = "Frequency response/Points: " + point.name;
        if (point.z)
        {
          const double down = mesh.radius - *point.z;
          own.angle = std::atan2(point.x, down);
          own.rows = elements.node({mesh.lateral_position + point.y, std::hypot(point.x, down)}, what);
        }
        else
        {
          const double first = point.x - parameters.load_length / 2, last = first + parameters.load_length,
                       middle = mesh.lateral_position + point.y, half = parameters.load_width / 2;
          if (std::max(std::abs(first), std::abs(last)) >= mesh.radius)
            throw InputError(what + " lies beside the tread of " + body.parameters.name + ", which reaches " +
                             number_text(mesh.radius) +
                             " m to either side along x; give it as name: x, y, z, direction.");
          const double from = std::asin(first / mesh.radius), to = std::asin(last / mesh.radius);
          own.angle = (from + to) / 2;
          own.half_angle = (to - from) / 2;
          for (const auto component :
               {RevolvedSection::axial, RevolvedSection::radial, RevolvedSection::circumferential})
            own.rows[component] = elements.mean_over(mesh.tread, middle - half, middle + half, component,
                                                     what + ", over its Load width,");
        }
        result.push_back(own);
      }
      return result;
    }
  } // namespace

  void BodyResponse::check_points(MeshedBody &body, const FrequencyResponseParameters &parameters)
  {
    if (body.parameters.is_revolved())
      revolved_points(body, parameters);
    else
      response_rows(body, parameters);
  }

  BodyResponse::BodyResponse(MeshedBody &body, const FrequencyResponseParameters &parameters,
                             const double speed)
      : body(body), parameters(parameters), speed(speed),
        cache(body.reduction.request().cache_directory, MPI_COMM_WORLD),
        key(body.reduction.request().key + points_key(parameters))
  {
  }

  void BodyResponse::check_count()
  {
    if (body.reduction.request().modes.count > 0)
      check_reach_of_modes(parameters.frequencies().back(), body.parameters.name,
                           body.reduction.modal().omega.back() / (2 * dealii::numbers::PI), "Count");
  }

  double BodyResponse::rotation() const
  {
    // material passes the contact towards +x, where theta grows
    return body.parameters.is_revolved() && body.parameters.rolls()
               ? speed / body.reduction.request().wheel->axle_height
               : 0.;
  }

  double BodyResponse::turning_axes() const
  {
    const auto &rotation = body.parameters.rotation;
    return rotation.has_coriolis() ? rotation.speed : 0.;
  }

  const ResponseReduction &BodyResponse::reduction()
  {
    const ReductionRequest &request = body.reduction.request();
    const std::string own_key = key + "Ritz vectors\nmodes " + request.modes.key();
    if (!reduced)
    {
      reduced = cache.load_response(request.body, own_key);
      if (reduced)
        run_log().line(request.body + ": response reduction found in the cache");
    }
    if (!reduced)
    {
      const Modes &modes = body.reduction.shapes();
      reduced = reduce_response(body.reduction.system(), body.reduction.flexibility(), modes,
                                body.reduction.modal().damping_ratio, bool(request.wheel), points());
      cache.save(request.body, own_key, *reduced);
      run_log().value("modal loss and static answers", reduced->seconds, "s");
    }
    return *reduced;
  }

  RevolvedResponse &BodyResponse::waves()
  {
    if (by_harmonics)
      return *by_harmonics;
    ModeParameters modes = body.reduction.request().modes;
    // of a count, those of all n below the last
    if (modes.count > 0)
    {
      modes.upper_frequency = (1 + 1e-9) * body.reduction.modal().omega.back() / (2 * dealii::numbers::PI);
      modes.count = 0;
    }
    const std::vector<RevolvedPoint> places = revolved_points(body, parameters);
    const RevolvedSection &elements = body.reduction.revolved().elements();
    const std::vector<WheelDamper> *const dampers = body.parameters.description->wheel_dampers();
    by_harmonics.emplace(
        elements, places, modes, body.section().n_harmonics, MPI_COMM_WORLD, rotation(),
        wheel_attachments(elements, dampers ? *dampers : std::vector<WheelDamper>(),
                          body.parameters.name + "/" + body.parameters.body_type().section + "/Damper"));
    return *by_harmonics;
  }

  ResponseVariant BodyResponse::direct(const std::vector<double> &frequency)
  {
    if (body.parameters.is_revolved())
    {
      const dealii::Timer timer;
      const std::vector<Receptance> found = waves().direct(frequency);
      run_log().value("direct solutions took", timer.wall_time() / frequency.size(), "s per frequency");
      return {"direct", 0, frequency, found, !waves().turns()};
    }
    const ReductionRequest &request = body.reduction.request();
    if (request.wheel)
      throw InputError("Frequency response: the damping of " + request.body +
                       " is given by mode, so that its unreduced equations have none; leave Check "
                       "frequencies out and set Method to modal.");
    const std::string own_key = key_at(key, frequency);
    auto found = cache.load_direct(request.body, own_key);
    if (found)
      run_log().line(request.body + ": direct solutions found in the cache");
    else
    {
      Progress progress("direct solutions of " + request.body, frequency.size());
      found = solve_directly(
          body.reduction.system(), points(), frequency, [&] { progress.advance(); }, turning_axes());
      cache.save(request.body, own_key, *found);
    }
    run_log().value("direct solutions took", found->seconds / frequency.size(), "s per frequency");
    return {"direct", 0, frequency, receptances(*found), turning_axes() == 0};
  }

  ResponseVariant BodyResponse::modal(const std::string &method, const double cut,
                                      const std::vector<double> &frequency)
  {
    if (body.parameters.is_revolved())
      return {method, waves().n_modes(cut), frequency, waves().modal(method == "hysteretic", cut, frequency),
              !waves().turns()};
    const ResponseReduction &modes = reduction();
    const unsigned int n = modes_below(modes, cut);
    return {method, n, frequency,
            method == "hysteretic" ? hysteretic_response(modes, n, frequency, turning_axes())
                                   : time_domain_response(modes, n, frequency, turning_axes()),
            turning_axes() == 0};
  }

  const std::vector<TraceRow> &BodyResponse::points()
  {
    if (rows.empty())
      rows = response_rows(body, parameters);
    return rows;
  }
} // namespace vibrocontact
