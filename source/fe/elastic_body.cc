#include <vibrocontact/fe/elastic_body.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/mapping_q.h>

namespace vibrocontact
{
  using namespace dealii;

  template <int dim>
  ElasticBody<dim>::ElasticBody(BodyMesh<dim> &&mesh_in, const ElasticModel<dim> &model,
                                const unsigned int degree)
      : mesh(std::move(mesh_in)), model(model), element(FE_Q<dim>(degree), dim),
        mapping(mesh.geometry_degree), dof_handler(*mesh.triangulation)
  {
    mapping.initialize(MappingQ<dim>(mesh.geometry_degree), *mesh.triangulation);
    dof_handler.distribute_dofs(element);
    locally_owned = dof_handler.locally_owned_dofs();
    DoFTools::extract_locally_relevant_dofs(dof_handler, locally_relevant);
    constraints.reinit(locally_relevant);
    DoFTools::make_hanging_node_constraints(dof_handler, constraints);
    for (const types::boundary_id id : model.held)
      DoFTools::make_zero_boundary_constraints(dof_handler, id, constraints);
    constraints.close();
  }

  template <int dim>
  PETScWrappers::MPI::Vector ElasticBody<dim>::complete(const PETScWrappers::MPI::Vector &owned) const
  {
    PETScWrappers::MPI::Vector all(locally_owned, communicator());
    all = owned;
    constraints.distribute(all);
    PETScWrappers::MPI::Vector ghosted(locally_owned, locally_relevant, communicator());
    ghosted = all;
    return ghosted;
  }

  template <int dim>
  std::vector<PETScWrappers::MPI::Vector> rigid_motions(const ElasticBody<dim> &body)
  {
    constexpr unsigned int n_rotations = dim * (dim - 1) / 2;
    std::vector<PETScWrappers::MPI::Vector> motions;
    for (unsigned int m = 0; m < dim + n_rotations; ++m)
      motions.emplace_back(body.locally_owned, body.communicator());

    const Quadrature<dim> nodes(body.element.get_unit_support_points());
    FEValues<dim> values(body.mapping, body.element, nodes, update_quadrature_points);
    std::vector<types::global_dof_index> dofs(body.element.n_dofs_per_cell());
    for (const auto &cell : body.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
      {
        values.reinit(cell);
        cell->get_dof_indices(dofs);
        for (unsigned int k = 0; k < dofs.size(); ++k)
        {
          if (!body.locally_owned.is_element(dofs[k]) || body.constraints.is_constrained(dofs[k]))
            continue;
          const unsigned int c = body.element.system_to_component_index(k).first;
          const Point<dim> &x = values.quadrature_point(k);
          motions[c](dofs[k]) = 1;
          // Rotation in the plane of axes a < b: u_a = -x_b, u_b = x_a.
          unsigned int m = dim;
          for (unsigned int a = 0; a < dim; ++a)
            for (unsigned int b = a + 1; b < dim; ++b, ++m)
              if (c == a)
                motions[m](dofs[k]) = -x[b];
              else if (c == b)
                motions[m](dofs[k]) = x[a];
        }
      }
    for (auto &motion : motions)
      motion.compress(VectorOperation::insert);

    // Gram-Schmidt twice: the rotations are about the contact point, far from the centre of mass.
    for (unsigned int m = 0; m < motions.size(); ++m)
    {
      for (unsigned int pass = 0; pass < 2; ++pass)
        for (unsigned int k = 0; k < m; ++k)
          motions[m].add(-(motions[m] * motions[k]), motions[k]);
      motions[m] /= motions[m].l2_norm();
    }
    return motions;
  }

  template class ElasticBody<2>;
  template class ElasticBody<3>;
  template std::vector<PETScWrappers::MPI::Vector> rigid_motions(const ElasticBody<2> &);
  template std::vector<PETScWrappers::MPI::Vector> rigid_motions(const ElasticBody<3> &);
} // namespace vibrocontact
