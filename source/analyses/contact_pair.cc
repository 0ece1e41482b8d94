#include <vibrocontact/analyses/contact_pair.h>
#include <vibrocontact/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vibrocontact
{
  HalfSpaceMaterial half_space_material(const BodyParameters &body)
  {
    if (body.type == "rigid")
      return {std::numeric_limits<double>::infinity(), 0.};
    return {body.material.young_modulus, body.material.poisson_ratio};
  }

  namespace
  {
    /// undeformed surface, its height above the tangent plane; side +1 for body 1 (above), -1 for body 2
    std::vector<double> surface_height(const ContactBody &body, const ContactGrid &grid, const double side)
    {
      if (body.reduced)
        return body.reduced->surface_height;
      const HalfSpaceParameters &surface = body.parameters->half_space;
      std::vector<double> height(grid.n_points());
      for (unsigned int i = 0; i < grid.n_points(); ++i)
        height[i] =
            side * 0.5 *
            (surface.curvature_x() * std::pow(grid.x(i), 2) + surface.curvature_y() * std::pow(grid.y(i), 2));
      return height;
    }

    // what the residual flexibility answers to the loads; the modes' part comes with their amplitudes
    void add_load_jump(const ReducedBody &body, const double side, DenseVector &jump)
    {
      if (std::all_of(body.residual_load_response.begin(), body.residual_load_response.end(),
                      [](const double value) { return value == 0; }))
        return;
      if (jump.size() == 0)
        jump.reinit(body.residual_load_response.size());
      for (unsigned int i = 0; i < jump.size(); ++i)
        jump[i] += side * body.residual_load_response[i];
    }

    DenseMatrix residual_flexibility(const ContactBody &body, const bool first,
                                     const ContactParameters &contact, const ContactGrid &grid)
    {
      if (body.reduced && !(body.parameters->is_solid() && contact.half_space_flexibility()))
        return body.reduced->residual_flexibility;
      if (body.parameters->type == "rigid")
        return DenseMatrix(3 * grid.n_points());
      const HalfSpaceMaterial own = half_space_material(*body.parameters),
                              rigid = {std::numeric_limits<double>::infinity(), 0.};
      return half_space_compliance(grid, first ? HalfSpacePair(own, rigid) : HalfSpacePair(rigid, own));
    }

    void uncouple(DenseMatrix &flexibility)
    {
      const unsigned int n = flexibility.m() / 3;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = n; j < 3 * n; ++j)
          flexibility(i, j) = flexibility(j, i) = 0;
    }

    // In plane strain nothing moves along y and nothing drives it there. A compliance of its own, which never
    // feels a force, keeps the lateral force of a sticking point determined (zero). It is of the size of the
    // compliance along x; with all modes kept that is the inertia's, far below the static one, and rho_t, which
    // follows the mean of both, must not notice this one.
    void hold_across(ContactPair &pair)
    {
      const unsigned int n = pair.n_points(), m = pair.n_modes();
      if (!pair.interface.grid.whole_surface || pair.interface.grid.n_y > 1)
        return;
      constexpr double beyond_all_modes = 1e3;
      const double fastest = m > 0 ? *std::max_element(pair.omega.begin(), pair.omega.end()) : 0;
      for (unsigned int i = 0; i < n; ++i)
      {
        const double residual = pair.residual_flexibility(n + i, n + i);
        double modal = 0, inertial = 0;
        for (unsigned int k = 0; k < m; ++k)
        {
          modal += std::pow(pair.modal_trace(n + i, k) / pair.omega[k], 2);
          inertial += std::pow(pair.modal_trace(n + i, k) / (beyond_all_modes * fastest), 2);
        }
        // round-off is all that remains of the residual when all modes are kept
        const double along_x = residual > 1e-9 * modal ? residual + modal : inertial;
        pair.residual_flexibility(2 * n + i, 2 * n + i) = along_x;
      }
    }
  } // namespace

  ContactInterface contact_interface(const ContactBody &body_1, const ContactBody &body_2,
                                     const ContactGrid &grid)
  {
    ContactInterface interface;
    interface.grid = grid;
    const std::vector<double> above = surface_height(body_1, grid, 1),
                              below = surface_height(body_2, grid, -1);
    for (unsigned int i = 0; i < grid.n_points(); ++i)
      interface.gap.push_back(above[i] - below[i]);
    for (const ContactBody *const body : {&body_1, &body_2})
      if (grid.traction != TractionShape::constant && !body->reduced &&
          body->parameters->type == "half-space")
        throw InputError(
            "Contact/Quadrature is consistent, but a half-space knows tractions that are constant on each "
            "cell only: set it to lumped.");
    return interface;
  }

  ContactPair contact_pair(const ContactBody &body_1, const ContactBody &body_2,
                           const ContactParameters &contact, const ContactGrid &grid)
  {
    ContactPair pair;
    pair.interface = contact_interface(body_1, body_2, grid);
    const unsigned int n = grid.n_points();
    pair.residual_flexibility = residual_flexibility(body_1, true, contact, grid);
    for (unsigned int i = 0; i < 3 * n; ++i)
      pair.force_residual.push_back(pair.residual_flexibility(i, 0));
    pair.residual_flexibility.add(1., residual_flexibility(body_2, false, contact, grid));
    if (!contact.coupling)
      uncouple(pair.residual_flexibility);
    unsigned int n_modes = 0, first = 0;
    for (const ContactBody *const body : {&body_1, &body_2})
      n_modes += body->reduced ? body->reduced->omega.size() : 0;
    pair.modal_trace.reinit(3 * n, n_modes);
    pair.participation.reinit(n_modes, 3);
    for (const ContactBody *const body : {&body_1, &body_2})
    {
      if (!body->reduced)
        continue;
      const ReducedBody &reduced = *body->reduced;
      const double side = body == &body_1 ? 1 : -1;
      for (unsigned int k = 0; k < reduced.omega.size(); ++k)
      {
        pair.omega.push_back(reduced.omega[k]);
        pair.damping_ratio.push_back(reduced.damping_ratio[k]);
        pair.labels.push_back(reduced.name + ":" + reduced.labels[k]);
        pair.body.push_back(body == &body_1 ? 1 : 2);
        pair.modal_load.push_back(reduced.modal_load[k]);
        for (unsigned int i = 0; i < 3 * n; ++i)
          pair.modal_trace(i, first + k) = side * reduced.modal_trace(i, k);
        for (unsigned int d = 0; d < 3 && reduced.participation.m() > 0; ++d)
          pair.participation(first + k, d) = reduced.participation(k, d);
      }
      first += reduced.omega.size();
      add_load_jump(reduced, side, pair.interface.load_jump);
    }
    hold_across(pair);
    return pair;
  }

  DenseMatrix static_compliance(const ContactPair &pair)
  {
    DenseMatrix result = pair.residual_flexibility;
    const auto rigid = std::find(pair.omega.begin(), pair.omega.end(), 0.);
    const std::string label = rigid == pair.omega.end() ? "" : pair.labels[rigid - pair.omega.begin()];
    add_modal_compliance(result, pair.modal_trace, pair.omega, label.substr(0, label.find(':')));
    return result;
  }

  ContactInterface static_interface(const ContactPair &pair)
  {
    ContactInterface interface = pair.interface;
    DenseVector &jump = interface.load_jump;
    for (unsigned int k = 0; k < pair.n_modes(); ++k)
    {
      if (pair.modal_load[k] == 0)
        continue;
      if (jump.size() == 0)
        jump.reinit(3 * pair.n_points());
      for (unsigned int i = 0; i < jump.size(); ++i)
        jump[i] += pair.modal_trace(i, k) * pair.modal_load[k] / (pair.omega[k] * pair.omega[k]);
    }
    return interface;
  }
} // namespace vibrocontact
