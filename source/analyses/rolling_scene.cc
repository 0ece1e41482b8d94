#include <vibrocontact/analyses/rolling_scene.h>
#include <vibrocontact/base/exceptions.h>

#include <cmath>
#include <limits>

namespace vibrocontact
{
  namespace
  {
    HalfSpaceMaterial material_of(const BodyParameters &body)
    {
      return {body.material.young_modulus, body.material.poisson_ratio};
    }

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

    void add_load_jump(const ReducedBody &body, const double side, DenseVector &jump)
    {
      bool loaded = false;
      for (const double value : body.residual_load_response)
        loaded = loaded || value != 0;
      for (const double value : body.modal_load)
        loaded = loaded || value != 0;
      if (!loaded)
        return;
      if (body.n_rigid_modes > 0)
        throw InputError("Body " + body.name +
                         " is free to move and carries a load: hold it or put it on springs.");
      if (jump.size() == 0)
        jump.reinit(3 * body.grid.n_points());
      for (unsigned int i = 0; i < body.residual_load_response.size(); ++i)
        jump[i] += side * body.residual_load_response[i];
      for (unsigned int k = 0; k < body.omega.size(); ++k)
        for (unsigned int i = 0; i < jump.size(); ++i)
          jump[i] += side * body.modal_trace(i, k) * body.modal_load[k] / std::pow(body.omega[k], 2);
    }
  } // namespace

  RollingScene rolling_scene(const ContactBody &body_1, const ContactBody &body_2,
                             const ContactParameters &contact)
  {
    RollingScene scene;
    const ContactGrid grid = contact.grid();
    scene.interface.grid = grid;
    const std::vector<double> above = surface_height(body_1, grid, 1),
                              below = surface_height(body_2, grid, -1);
    for (unsigned int i = 0; i < grid.n_points(); ++i)
      scene.interface.gap.push_back(above[i] - below[i]);
    if (body_1.reduced)
      for (unsigned int i = 0; i < grid.n_points(); ++i)
        if (std::abs(body_1.reduced->lifting[i] - 1) > 1e-9)
          throw InputError(
              "Body " + body_1.parameters->name +
              " cannot be pressed down by its hub: body 1 must be carried by a held boundary alone, without "
              "springs; make it body 2 or hold it.");
    if (body_1.reduced)
      add_load_jump(*body_1.reduced, 1, scene.interface.load_jump);
    if (body_2.reduced)
      add_load_jump(*body_2.reduced, -1, scene.interface.load_jump);

    if (grid.traction != TractionShape::constant && (!body_1.reduced || !body_2.reduced))
      throw InputError(
          "Contact/Quadrature is consistent, but a half-space knows tractions that are constant on each "
          "cell only: set it to lumped.");
    const CreepScheme &scheme = find_creep_scheme(contact.creep_scheme);
    if (!body_1.reduced && !body_2.reduced)
    {
      const auto curvature = [&](const auto get)
      { return get(body_1.parameters->half_space) + get(body_2.parameters->half_space); };
      const double x = curvature([](const HalfSpaceParameters &p) { return p.curvature_x(); });
      const double y = curvature([](const HalfSpaceParameters &p) { return p.curvature_y(); });
      if (!(x > 0) || (!(y > 0) && contact.strip_length == 0))
        throw InputError(
            "The half-spaces " + body_1.parameters->name + " and " + body_2.parameters->name +
            " do not touch in a point: their curvatures 1/Radius x, 1/Radius y must sum to a positive number "
            "in both directions (along x alone with a Contact/Strip length).");
      const HalfSpacePair pair(material_of(*body_1.parameters), material_of(*body_2.parameters));
      scene.operator_at = [=](const double speed) { return rolling_operator(grid, pair, scheme, speed); };
      return scene;
    }

    const HalfSpaceMaterial rigid = {std::numeric_limits<double>::infinity(), 0.};
    const auto compliance_of = [&](const ContactBody &body, const bool first)
    {
      if (body.reduced)
        return static_compliance(*body.reduced);
      const HalfSpaceMaterial own = material_of(*body.parameters);
      return half_space_compliance(grid, first ? HalfSpacePair(own, rigid) : HalfSpacePair(rigid, own));
    };
    auto compliance = std::make_shared<DenseMatrix>(compliance_of(body_1, true));
    compliance->add(1., compliance_of(body_2, false));
    scene.operator_at = [=](const double speed)
    { return rolling_operator(grid, *compliance, scheme, speed); };
    return scene;
  }
} // namespace vibrocontact
