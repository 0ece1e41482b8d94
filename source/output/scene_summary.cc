#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/output/scene_summary.h>

#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cstdio>

namespace vibrocontact
{
  namespace
  {
    /// Extent of the locally owned cells along each axis, joined over the ranks [m].
    std::string extent_text(const ElasticBody<3> &body)
    {
      dealii::Point<3> low(1e9, 1e9, 1e9), high(-1e9, -1e9, -1e9);
      for (const auto &cell : body.mesh.triangulation->active_cell_iterators())
        if (cell->is_locally_owned())
          for (const unsigned int v : cell->vertex_indices())
            for (unsigned int d = 0; d < 3; ++d)
            {
              low[d] = std::min(low[d], cell->vertex(v)[d]);
              high[d] = std::max(high[d], cell->vertex(v)[d]);
            }
      std::string text;
      for (unsigned int d = 0; d < 3; ++d)
      {
        const double size = dealii::Utilities::MPI::max(high[d], body.communicator()) -
                            dealii::Utilities::MPI::min(low[d], body.communicator());
        char number[32];
        std::snprintf(number, sizeof number, "%s%.4g", d ? " x " : "", size);
        text += number;
      }
      return text + " m (x, y, z)";
    }
  } // namespace

  void print_body(const BodyParameters &parameters, const ElasticBody<3> *const body)
  {
    Log &log = run_log();
    log.block("Body " + parameters.name);
    log.value("type", parameters.type + " (" + parameters.body_type().help + ")");
    const auto print_material = [&](const ElasticMaterial &material, const std::string &of)
    {
      if (material.is_orthotropic())
      {
        const OrthotropicElasticity &own = material.orthotropic;
        const auto three = [](const double a, const double b, const double c)
        { return number_text(a) + ", " + number_text(b) + ", " + number_text(c); };
        log.value("Young moduli along axes 1, 2, 3" + of, three(own.E1, own.E2, own.E3) + " Pa");
        log.value("Poisson ratios 12, 13, 23" + of, three(own.nu12, own.nu13, own.nu23));
        log.value("shear moduli 12, 13, 23" + of, three(own.G12, own.G13, own.G23) + " Pa");
        log.value("axis 1" + of, three(own.axis_1[0], own.axis_1[1], own.axis_1[2]));
        log.value("in the plane of axes 1 and 2" + of, three(own.axis_2[0], own.axis_2[1], own.axis_2[2]));
      }
      else
      {
        log.value("Young modulus" + of, material.young_modulus, "Pa");
        log.value("Poisson ratio" + of, material.poisson_ratio);
      }
      log.value("density" + of, material.density, "kg/m^3");
      if (material.loss_factor > 0)
        log.value("loss factor" + of, material.loss_factor);
    };
    for (const auto &[group, material] : parameters.materials)
      print_material(material, " of " + group);
    if (parameters.description->has_material() && parameters.materials.empty())
      print_material(parameters.material, "");
    if (parameters.rotation.turns())
    {
      const dealii::Tensor<1, 3> axis = parameters.rotation.steady().axis;
      log.value("turns at", parameters.rotation.speed, "rad/s");
      log.value("about",
                number_text(axis[0]) + ", " + number_text(axis[1]) + ", " + number_text(axis[2]) +
                    (parameters.rotation.coriolis ? ", with Coriolis forces" : ", without Coriolis forces"));
    }
    if (parameters.is_prestressed())
      log.value("stiffness", "with the stress of its loads, to first order");
    parameters.description->print(log);
    if (!body)
      return;
    const double n_dofs = body->dof_handler.n_dofs();
    log.value("size", extent_text(*body));
    log.value("cells", static_cast<unsigned long long>(body->mesh.triangulation->n_global_active_cells()));
    log.value("dofs", static_cast<unsigned long long>(n_dofs));
    std::string names;
    for (const auto &boundary : body->mesh.boundaries)
      names += (names.empty() ? "" : ", ") + boundary.first;
    log.value("boundaries", names);
  }

  void print_contact_grid(const ContactGrid &grid)
  {
    Log &log = run_log();
    log.block("Contact grid");
    log.value("points", std::to_string(grid.n_x) + " x " + std::to_string(grid.n_y));
    log.value("spacing along x", grid.spacing_x * 1e3, "mm");
    log.value("spacing along y", grid.spacing_y * 1e3, "mm");
    log.value("first point x", grid.x_first * 1e3, "mm");
    log.value("first point y", grid.y_first * 1e3, "mm");
  }
} // namespace vibrocontact
