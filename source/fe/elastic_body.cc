#include <vibrocontact/fe/elastic_body.h>
#include <vibrocontact/numerics/eigenvalues.h>
#include <vibrocontact/scene/cell_elements.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/vector.h>

#include <algorithm>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    /// Of each dof of a cell.
    template <int dim>
    std::vector<Point<dim>> node_points_of(const FESystem<dim> &element)
    {
      const std::vector<Point<dim>> nodes = scalar_node_points<dim>(element.base_element(0));
      std::vector<Point<dim>> result;
      for (unsigned int k = 0; k < element.n_dofs_per_cell(); ++k)
        result.push_back(nodes[element.system_to_component_index(k).second]);
      return result;
    }

    /// Zero in the held directions on the nodes of the held faces, whatever the shape of the cells.
    template <int dim>
    void hold_boundaries(const ElasticBody<dim> &body, AffineConstraints<double> &constraints)
    {
      const ReferenceCell shape = body.element.reference_cell();
      std::vector<types::global_dof_index> dofs(body.element.n_dofs_per_cell());
      for (const auto &cell : body.dof_handler.active_cell_iterators())
        if (!cell->is_artificial())
          for (const unsigned int f : cell->face_indices())
          {
            if (!cell->face(f)->at_boundary())
              continue;
            for (const HeldBoundary<dim> &held : body.model.held)
            {
              if (held.boundary != cell->face(f)->boundary_id())
                continue;
              cell->get_dof_indices(dofs);
              for (unsigned int k = 0; k < dofs.size(); ++k)
                if (held.directions[body.element.system_to_component_index(k).first] &&
                    lies_on_face<dim>(shape, f, body.node_points[k]))
                  constraints.add_line(dofs[k]);
            }
          }
    }
  } // namespace

  template <int dim>
  ElasticBody<dim>::ElasticBody(BodyMesh<dim> &&mesh_in, const ElasticModel<dim> &model,
                                const unsigned int degree)
      : mesh(std::move(mesh_in)), model(model),
        element(*scalar_element<dim>(mesh.reference_cell(), degree), dim),
        node_points(node_points_of(element)), own_mapping(make_mapping(mesh)), mapping(*own_mapping),
        dof_handler(*mesh.triangulation)
  {
    dof_handler.distribute_dofs(element);
    locally_owned = dof_handler.locally_owned_dofs();
    DoFTools::extract_locally_relevant_dofs(dof_handler, locally_relevant);
    constraints.reinit(locally_relevant);
    if (mesh.is_hypercube())
      DoFTools::make_hanging_node_constraints(dof_handler, constraints);
    hold_boundaries(*this, constraints);
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

  namespace
  {
    using Motions = std::vector<PETScWrappers::MPI::Vector>;

    /// Not of what hangs between nodes that move.
    template <int dim>
    bool is_held(const ElasticBody<dim> &body, const types::global_dof_index dof)
    {
      return body.constraints.is_constrained(dof) && body.constraints.get_constraint_entries(dof)->empty();
    }

    /// part of a motion in what holds the body, by the squares of its values; others have rounding there
    constexpr double held_part = 1e-12;

    void orthonormalise(Motions &motions)
    {
      // Gram-Schmidt twice: the rotations are about the contact point, far from the centre of mass.
      for (unsigned int m = 0; m < motions.size(); ++m)
      {
        for (unsigned int pass = 0; pass < 2; ++pass)
          for (unsigned int k = 0; k < m; ++k)
            motions[m].add(-(motions[m] * motions[k]), motions[k]);
        motions[m] /= motions[m].l2_norm();
      }
    }

    /// @param with_held also the dofs that are held have values
    template <int dim>
    Motions motions_of_nodes(const ElasticBody<dim> &body, const bool with_held)
    {
      constexpr unsigned int n_rotations = dim * (dim - 1) / 2;
      Motions motions;
      for (unsigned int m = 0; m < dim + n_rotations; ++m)
        motions.emplace_back(body.locally_owned, body.communicator());

      const Quadrature<dim> nodes(body.node_points);
      FEValues<dim> values(body.mapping, body.element, nodes, update_quadrature_points);
      std::vector<types::global_dof_index> dofs(body.element.n_dofs_per_cell());
      for (const auto &cell : body.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
        {
          values.reinit(cell);
          cell->get_dof_indices(dofs);
          for (unsigned int k = 0; k < dofs.size(); ++k)
          {
            if (!body.locally_owned.is_element(dofs[k]) ||
                (body.constraints.is_constrained(dofs[k]) && !(with_held && is_held(body, dofs[k]))))
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
      orthonormalise(motions);
      return motions;
    }
  } // namespace

  template <int dim>
  std::vector<PETScWrappers::MPI::Vector> rigid_motions(const ElasticBody<dim> &body)
  {
    return motions_of_nodes(body, false);
  }

  template <int dim>
  std::vector<PETScWrappers::MPI::Vector> free_rigid_motions(const ElasticBody<dim> &body)
  {
    const ElasticModel<dim> &model = body.model;
    if (!model.is_supported())
      return rigid_motions(body);
    if (!model.springs.empty() ||
        std::any_of(model.held.begin(), model.held.end(),
                    [](const HeldBoundary<dim> &part) { return part.is_clamped(); }))
      return {};
    const Motions all = motions_of_nodes(body, true);
    Motions held = all;
    for (PETScWrappers::MPI::Vector &motion : held)
    {
      const auto [begin, end] = motion.local_range();
      for (auto dof = begin; dof < end; ++dof)
        if (!is_held(body, dof))
          motion(dof) = 0;
      motion.compress(VectorOperation::insert);
    }
    const unsigned int n = all.size();
    DenseMatrix shares(n, n), vectors;
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int l = 0; l < n; ++l)
        shares(k, l) = held[k] * held[l];
    const std::vector<double> values = symmetric_eigenvalues(shares, vectors);
    const unsigned int n_free =
        std::count_if(values.begin(), values.end(), [](const double value) { return value < held_part; });
    // The space is known, but any basis of it would do: one on which all numbers of ranks agree is that of the first motions, in
    // order, of which something new is in it. What is left of all six has a whole number as the sum of its squares.
    constexpr double something = 0.1;
    std::vector<dealii::Vector<double>> chosen;
    for (unsigned int k = 0; k < n; ++k)
    {
      dealii::Vector<double> part(n);
      for (unsigned int m = 0; m < n_free; ++m)
        for (unsigned int l = 0; l < n; ++l)
          part(l) += vectors(k, m) * vectors(l, m);
      for (const dealii::Vector<double> &other : chosen)
        part.add(-(part * other), other);
      if (part.l2_norm() < something)
        continue;
      part /= part.l2_norm();
      chosen.push_back(part);
    }
    Motions motions;
    for (const dealii::Vector<double> &part : chosen)
    {
      motions.emplace_back(body.locally_owned, body.communicator());
      for (unsigned int k = 0; k < n; ++k)
      {
        motions.back().add(part(k), all[k]);
        motions.back().add(-part(k), held[k]);
      }
    }
    orthonormalise(motions);
    return motions;
  }

  template class ElasticBody<2>;
  template class ElasticBody<3>;
  template std::vector<PETScWrappers::MPI::Vector> rigid_motions(const ElasticBody<2> &);
  template std::vector<PETScWrappers::MPI::Vector> rigid_motions(const ElasticBody<3> &);
  template std::vector<PETScWrappers::MPI::Vector> free_rigid_motions(const ElasticBody<2> &);
  template std::vector<PETScWrappers::MPI::Vector> free_rigid_motions(const ElasticBody<3> &);
} // namespace vibrocontact
