#include <vibrocontact/fe/elastic_body.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_values.h>

namespace vibrocontact
{
  using namespace dealii;

  template <int dim>
  void describe_dofs(const ElasticBody<dim> &body, SecondOrderSystem &system)
  {
    system.dof_position.resize(body.locally_owned.n_elements());
    system.dof_direction.resize(body.locally_owned.n_elements());
    FEValues<dim> values(body.mapping, body.element, Quadrature<dim>(body.element.get_unit_support_points()),
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

  template void describe_dofs(const ElasticBody<2> &, SecondOrderSystem &);
  template void describe_dofs(const ElasticBody<3> &, SecondOrderSystem &);
} // namespace vibrocontact
