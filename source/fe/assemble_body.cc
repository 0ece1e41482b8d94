#include <vibrocontact/fe/assemble_body.h>
#include <vibrocontact/fe/elasticity.h>
#include <vibrocontact/fe/surface_assembly.h>
#include <vibrocontact/fe/trace_assembly.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_values.h>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    /// Fills dof_position and dof_direction of the body's system.
    template <int dim>
    void describe_dofs(const ElasticBody<dim> &body, SecondOrderSystem &system)
    {
      system.dof_position.resize(body.locally_owned.n_elements());
      system.dof_direction.resize(body.locally_owned.n_elements());
      FEValues<dim> values(body.mapping, body.element, Quadrature<dim>(body.node_points),
                           update_quadrature_points);
      std::vector<types::global_dof_index> dofs(body.element.n_dofs_per_cell());
      for (const auto &cell : body.dof_handler.active_cell_iterators())
        if (!cell->is_artificial())
        {
          values.reinit(cell);
          cell->get_dof_indices(dofs);
          for (unsigned int k = 0; k < dofs.size(); ++k)
            if (body.locally_owned.is_element(dofs[k]))
            {
              const auto i = body.locally_owned.index_within_set(dofs[k]);
              const unsigned int c = body.element.system_to_component_index(k).first;
              // A plane body lies in the plane of x and z.
              system.dof_direction[i] = dim == 2 && c == 1 ? 2 : c;
              for (unsigned int d = 0; d < dim; ++d)
                system.dof_position[i][dim == 2 && d == 1 ? 2 : d] = values.quadrature_point(k)[d];
            }
        }
    }
  } // namespace

  template <int dim>
  std::unique_ptr<SecondOrderSystem> assemble_body(const ElasticBody<dim> &body,
                                                   const ContactGrid *const grid)
  {
    std::unique_ptr<SecondOrderSystem> system = assemble_elasticity(body);
    system->rigid_motions = free_rigid_motions(body);
    system->n_rigid_modes = system->rigid_motions.size();
    describe_dofs(body, *system);
    system->surface = make_surface_trace(body);
    // its own centrifugal forces hold a body that turns back
    system->follows_hub = body.model.is_clamped() && body.model.springs.empty() && !body.model.turns();
    if (grid)
      system->trace = make_contact_trace(body, *grid);
    return system;
  }

  template std::unique_ptr<SecondOrderSystem> assemble_body(const ElasticBody<2> &, const ContactGrid *);
  template std::unique_ptr<SecondOrderSystem> assemble_body(const ElasticBody<3> &, const ContactGrid *);
} // namespace vibrocontact
