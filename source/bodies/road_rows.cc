#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/bodies/road_rows.h>
#include <vibrocontact/scene/body_description.h>

#include <algorithm>

namespace vibrocontact
{
  namespace
  {
    /// What unit translations along the two tangential axes feed into the modes, for axes that point the other way.
    void turn_participation(BodyInContact &body, const double sign)
    {
      for (unsigned int k = 0; k < body.participation.m(); ++k)
        for (unsigned int d = 0; d < 2; ++d)
          body.participation(k, d) *= sign;
    }
  } // namespace

  BodyInContact road_rows(const ReducedBody &body, const bool with_friction, const double forward)
  {
    const unsigned int n = body.surface_height.size();
    std::vector<SignedRow> rows;
    for (unsigned int i = 0; i < (with_friction ? 2 * n : n); ++i)
      rows.push_back({i, i < n ? 1. : forward});
    BodyInContact result = with_rows(body, rows);
    turn_participation(result, forward);
    return result;
  }

  ReducedBody contact_rows(const BodyInContact &body, const std::string &name, const ContactGrid &grid,
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
    ReducedBody result;
    static_cast<BodyInContact &>(result) = with_rows(body, rows);
    result.name = name;
    result.grid = grid;
    result.n_rigid_modes = std::count(body.omega.begin(), body.omega.end(), 0.);
    result.modal_load.resize(m);
    result.pole_load.resize(body.n_poles());
    for (std::size_t k = result.labels.size(); k < m + body.n_poles(); ++k)
      result.labels.push_back(k < m ? "mode " + std::to_string(k + 1) : "pole " + std::to_string(k - m + 1));
    turn_participation(result, -1);
    // along an axis that points backwards
    for (unsigned int k = 0; k < result.gradient.n(); ++k)
      for (unsigned int i = 0; i < result.gradient.m(); ++i)
        result.gradient(i, k) = -result.gradient(i, k);
    if (result.gradient.m() > 0)
      result.residual_gradient *= -1.;
    result.lifting.assign(3 * n, 0.);
    std::fill_n(result.lifting.begin(), n, 1.);
    result.surface_height.assign(heights.rbegin(), heights.rend());
    return result;
  }

  BodyInContact BodyDescription::on_road(const ReducedBody &reduced, const bool with_friction, double,
                                         const std::vector<double> &) const
  {
    return road_rows(reduced, with_friction, -1);
  }
} // namespace vibrocontact
