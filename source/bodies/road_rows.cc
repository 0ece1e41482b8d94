#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/bodies/road_rows.h>
#include <vibrocontact/scene/body_description.h>

#include <algorithm>

namespace vibrocontact
{
  BodyInContact road_rows(const ReducedBody &body, const bool with_friction, const double forward)
  {
    const unsigned int n = body.grid.n_points(), n_rows = with_friction ? 2 * n : n, m = body.omega.size();
    const auto sign = [&](const unsigned int row) { return row < n ? 1. : forward; };
    BodyInContact result;
    result.omega = body.omega;
    result.damping_ratio = body.damping_ratio;
    result.modal_load = body.modal_load;
    result.labels = body.labels;
    result.participation = body.participation;
    for (unsigned int k = 0; k < m && body.participation.m() > 0; ++k)
      for (unsigned int d = 0; d < 2; ++d)
        result.participation(k, d) *= forward;
    result.trace.reinit(n_rows, m);
    result.residual.reinit(n_rows, n_rows);
    for (unsigned int i = 0; i < n_rows; ++i)
    {
      for (unsigned int k = 0; k < m; ++k)
        result.trace(i, k) = sign(i) * body.modal_trace(i, k);
      for (unsigned int j = 0; j < n_rows; ++j)
        result.residual(i, j) = sign(i) * sign(j) * body.residual_flexibility(i, j);
    }
    return result;
  }

  ContactRows contact_rows(const BodyInContact &body, const std::string &name, const ContactGrid &grid,
                           const std::vector<double> &heights)
  {
    const unsigned int n = grid.n_points(), n_rows = body.n_rows(), m = body.n_modes();
    if (n_rows != n && n_rows != 2 * n)
      throw InputError("The body " + name + " is known at " + std::to_string(n_rows) +
                       " places, but its contact has " + std::to_string(n) +
                       " points: give a position for each of them.");
    // the grid runs backwards
    std::vector<SignedRow> rows(3 * n, {0, 0.});
    for (unsigned int i = 0; i < n_rows; ++i)
      rows[i < n ? n - 1 - i : 3 * n - 1 - i] = {i, i < n ? 1. : -1.};
    BodyInContact turned = with_rows(body, rows);
    ContactRows result;
    ReducedBody &reduced = result.reduced;
    reduced.name = name;
    reduced.grid = grid;
    reduced.n_rigid_modes = std::count(body.omega.begin(), body.omega.end(), 0.);
    reduced.omega = body.omega;
    reduced.damping_ratio = body.damping_ratio;
    reduced.labels.assign(body.labels.begin(),
                          body.labels.begin() + std::min<std::size_t>(m, body.labels.size()));
    reduced.modal_trace = turned.trace;
    reduced.modal_load = body.modal_load;
    reduced.modal_load.resize(m);
    reduced.participation = body.participation;
    for (unsigned int k = 0; k < m && body.participation.m() > 0; ++k)
      for (unsigned int d = 0; d < 2; ++d)
        reduced.participation(k, d) *= -1;
    reduced.residual_flexibility = turned.residual;
    reduced.residual_load_response = turned.residual_load;
    reduced.lifting.assign(3 * n, 0.);
    std::fill_n(reduced.lifting.begin(), n, 1.);
    reduced.surface_height.assign(heights.rbegin(), heights.rend());

    BodyInContact &poles = result.poles;
    poles.poles = body.poles;
    poles.right = turned.right;
    poles.left = turned.left;
    // along an axis that points backwards
    poles.gradient = turned.gradient;
    for (unsigned int k = 0; k < poles.gradient.n(); ++k)
      for (unsigned int i = 0; i < poles.gradient.m(); ++i)
        poles.gradient(i, k) = -turned.gradient(i, k);
    poles.residual_gradient = turned.residual_gradient;
    poles.residual_gradient *= -1.;
    poles.pole_load = body.pole_load;
    poles.pole_load.resize(body.n_poles());
    for (unsigned int k = 0; k < body.n_poles(); ++k)
      poles.labels.push_back(m + k < body.labels.size() ? body.labels[m + k]
                                                        : "pole " + std::to_string(k + 1));
    return result;
  }

  BodyInContact BodyDescription::on_road(const ReducedBody &reduced, const bool with_friction) const
  {
    return road_rows(reduced, with_friction, -1);
  }
} // namespace vibrocontact
