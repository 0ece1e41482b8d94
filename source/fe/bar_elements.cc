#include <vibrocontact/base/number_text.h>
#include <vibrocontact/fe/bar_elements.h>
#include <vibrocontact/fe/nearest_dof.h>
#include <vibrocontact/scene/body.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/utilities.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <cmath>

namespace vibrocontact
{
  using namespace dealii;

  std::unique_ptr<SecondOrderSystem> assemble_bar(const BarParameters &bar, const ElasticMaterial &material,
                                                  const std::string &name, const bool above,
                                                  const ContactGrid *const grid, const MPI_Comm communicator,
                                                  const double gravity)
  {
    // The mesh is small and stands on every rank; each assembles its share of the rows.
    Triangulation<1> mesh;
    GridGenerator::subdivided_hyper_cube(mesh, bar.divisions, 0., bar.length);
    const FE_Q<1> element(bar.degree);
    DoFHandler<1> dof_handler(mesh);
    dof_handler.distribute_dofs(element);
    std::vector<Point<1>> places(dof_handler.n_dofs());
    DoFTools::map_dofs_to_support_points(MappingQ1<1>(), dof_handler, places);

    auto system = std::make_unique<SecondOrderSystem>();
    system->body = name;
    system->communicator = communicator;
    system->locally_owned = Utilities::create_evenly_distributed_partitioning(
        Utilities::MPI::this_mpi_process(communicator), Utilities::MPI::n_mpi_processes(communicator),
        dof_handler.n_dofs());
    AffineConstraints<double> constraints;
    types::global_dof_index contact_end = 0;
    for (types::global_dof_index i = 0; i < places.size(); ++i)
    {
      if (places[i][0] < 1e-9 * bar.length)
        contact_end = i;
      if (bar.far_end_is_held() && places[i][0] > (1 - 1e-9) * bar.length)
        constraints.add_line(i);
    }
    constraints.close();

    DynamicSparsityPattern pattern(dof_handler.n_dofs());
    DoFTools::make_sparsity_pattern(dof_handler, pattern, constraints, true);
    for (auto *const matrix : {&system->mass, &system->stiffness})
      matrix->reinit(system->locally_owned, system->locally_owned, pattern, communicator);

    system->has_load = gravity != 0;
    if (system->has_load)
      system->load.reinit(system->locally_owned, communicator);

    FEValues<1> values(element, QGauss<1>(bar.degree + 1),
                       update_values | update_gradients | update_JxW_values);
    const unsigned int n = element.n_dofs_per_cell();
    FullMatrix<double> mass(n), stiffness(n);
    std::vector<types::global_dof_index> dofs(n);
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      values.reinit(cell);
      cell->get_dof_indices(dofs);
      mass = stiffness = 0;
      for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int b = 0; b < n; ++b)
          {
            mass(a, b) += material.density * bar.section * values.shape_value(a, q) *
                          values.shape_value(b, q) * values.JxW(q);
            stiffness(a, b) += material.young_modulus * bar.section * values.shape_grad(a, q)[0] *
                               values.shape_grad(b, q)[0] * values.JxW(q);
          }
      if (bar.consistent_mass != 1)
        for (unsigned int a = 0; a < n; ++a)
        {
          double lumped = 0;
          for (unsigned int b = 0; b < n; ++b)
          {
            lumped += mass(a, b);
            mass(a, b) *= bar.consistent_mass;
          }
          mass(a, a) += (1 - bar.consistent_mass) * lumped;
        }
      // vertex dofs come first: 0 is the one towards the contact end
      if (bar.massless_contact_node && dofs[0] == contact_end)
      {
        mass = 0;
        mass(1, 1) = material.density * bar.section * cell->measure();
      }
      for (unsigned int a = 0; a < n; ++a)
      {
        if (!system->locally_owned.is_element(dofs[a]))
          continue;
        const bool fixed = constraints.is_constrained(dofs[a]);
        for (unsigned int b = 0; b < n; ++b)
          if (a == b || (!fixed && !constraints.is_constrained(dofs[b])))
          {
            system->stiffness.add(dofs[a], dofs[b], stiffness(a, b));
            if (!fixed)
              system->mass.add(dofs[a], dofs[b], mass(a, b));
          }
        if (system->has_load && !fixed)
        {
          double weight = 0;
          for (unsigned int b = 0; b < n; ++b)
            weight += gravity * mass(a, b);
          system->load(dofs[a]) += -weight;
        }
      }
    }
    system->mass.compress(VectorOperation::add);
    system->stiffness.compress(VectorOperation::add);
    if (system->has_load)
      system->load.compress(VectorOperation::add);
    if (material.loss_factor > 0)
    {
      system->loss_stiffness.reinit(system->stiffness);
      system->loss_stiffness.copy_from(system->stiffness);
      system->loss_stiffness *= material.loss_factor;
      system->has_loss = true;
    }

    system->total_mass = material.density * bar.section * bar.length;
    if (!bar.far_end_is_held())
    {
      PETScWrappers::MPI::Vector motion(system->locally_owned, communicator);
      motion = 1. / std::sqrt(double(dof_handler.n_dofs()));
      system->rigid_motions.push_back(motion);
      system->n_rigid_modes = 1;
    }
    system->follows_hub = bar.far_end_is_held();
    for (const auto dof : system->locally_owned)
    {
      system->dof_position.emplace_back(0., 0., (above ? 1 : -1) * places[dof][0]);
      system->dof_direction.push_back(2);
    }
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      const int first = system->surface.points.size();
      for (unsigned int v = 0; v < 2; ++v)
      {
        const types::global_dof_index dof = cell->vertex_dof_index(v, 0);
        system->surface.points.emplace_back(0., 0., (above ? 1 : -1) * places[dof][0]);
        system->surface.rows.resize(3 * system->surface.points.size());
        if (!constraints.is_constrained(dof))
          system->surface.rows.back() = {{dof, 1.}};
      }
      system->surface.quads.push_back({{first, first + 1, first + 1, first}});
    }
    if (grid)
    {
      AssertThrow(grid->n_points() == 1, ExcMessage("A bar has one contact point."));
      system->trace.grid = *grid;
      system->trace.rows.resize(3);
      system->trace.rows[0] = {{contact_end, 1.}};
      system->trace.surface_height = {0.};
    }
    return system;
  }

  std::unique_ptr<SecondOrderSystem> BarParameters::assemble(const BodyParameters &body, const bool above,
                                                             const ContactGrid *const grid,
                                                             const MPI_Comm communicator) const
  {
    return assemble_bar(*this, body.material, body.name, above, grid, communicator, body.loads.gravity);
  }

  void BarParameters::move_contact(const SecondOrderSystem &system, ContactTrace &trace, const double z) const
  {
    trace.rows[0] = nearest_dof(system, {0., 0., z}, 2,
                                "The contact of " + system.body + " at z = " + number_text(z) + " m");
  }
} // namespace vibrocontact
