#include <vibrocontact/fe/attached_points.h>
#include <vibrocontact/fe/prestress.h>
#include <vibrocontact/scene/cell_elements.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    /// Also of the direction across a plane body, whose strain is zero.
    template <int dim>
    SymmetricTensor<2, 3> in_space(const SymmetricTensor<2, dim> &strain)
    {
      SymmetricTensor<2, 3> result;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j <= i; ++j)
          result[i][j] = strain[i][j];
      return result;
    }

    template <int dim>
    void add_pressure(const FaceValues<dim> &values, const FESystem<dim> &element, const double pressure,
                      FullMatrix<double> &matrix)
    {
      const auto term = [&](const unsigned int k, const unsigned int l, const unsigned int q)
      {
        const auto [i, a] = element.system_to_component_index(k);
        const auto [j, b] = element.system_to_component_index(l);
        const Tensor<1, dim> n = values.normal_vector(q), slope = values.shape_grad(b, q);
        return values.shape_value(a, q) * (n[i] * slope[j] - n[j] * slope[i]);
      };
      for (unsigned int q = 0; q < values.n_points(); ++q)
        for (unsigned int a = 0; a < matrix.m(); ++a)
          for (unsigned int b = 0; b < matrix.n(); ++b)
            matrix(a, b) += pressure / 2 * (term(a, b, q) + term(b, a, q)) * values.JxW(q);
    }
  } // namespace

  template <int dim>
  PrestressNumbers add_prestress(const ElasticBody<dim> &body, const PETScWrappers::MPI::Vector &displacement,
                                 SecondOrderSystem &system)
  {
    const ElasticModel<dim> &model = body.model;
    const PETScWrappers::MPI::Vector u = body.complete(displacement);
    const FESystem<dim> &element = body.element;
    const FiniteElement<dim> &scalar = element.base_element(0);
    const unsigned int n = element.n_dofs_per_cell(), n_nodes = scalar.n_dofs_per_cell(),
                       n_gauss = n_gauss_points(body.mesh, scalar);
    FEValues<dim> values(body.mapping, scalar, cell_quadrature<dim>(scalar.reference_cell(), n_gauss),
                         update_values | update_gradients | update_JxW_values);
    FaceValues<dim> face_values(body.mapping, scalar, n_gauss, true);
    FullMatrix<double> matrix(n, n), stretch(n_nodes, n_nodes), inertia(n_nodes, n_nodes);
    std::vector<types::global_dof_index> dofs(n);
    std::vector<Tensor<1, dim>> slopes(n_nodes), pulled(n_nodes);
    const double square = model.rotation.speed * model.rotation.speed;
    const Tensor<1, dim> &axis = model.rotation.axis;
    PrestressNumbers numbers;
    for (const auto &cell : body.dof_handler.active_cell_iterators())
    {
      if (!cell->is_locally_owned())
        continue;
      values.reinit(typename Triangulation<dim>::active_cell_iterator(cell));
      cell->get_dof_indices(dofs);
      const ElasticMaterial &material = model.material_of(cell->material_id());
      const SymmetricTensor<4, 3> stiffness = material.stiffness();
      stretch = 0;
      inertia = 0;
      for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
      {
        Tensor<2, dim> gradient;
        for (unsigned int k = 0; k < n; ++k)
        {
          const auto [component, node] = element.system_to_component_index(k);
          gradient[component] += u(dofs[k]) * values.shape_grad(node, q);
        }
        const SymmetricTensor<2, 3> whole = stiffness * in_space<dim>(symmetrize(gradient));
        SymmetricTensor<2, dim> stress;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j <= i; ++j)
            stress[i][j] = whole[i][j];
        numbers.largest_stress = std::max(numbers.largest_stress, std::sqrt(1.5) * deviator(whole).norm());
        numbers.largest_gradient = std::max(numbers.largest_gradient, gradient.norm());
        for (unsigned int a = 0; a < n_nodes; ++a)
        {
          slopes[a] = values.shape_grad(a, q);
          pulled[a] = values.JxW(q) * (stress * slopes[a]);
        }
        for (unsigned int a = 0; a < n_nodes; ++a)
          for (unsigned int b = 0; b < n_nodes; ++b)
          {
            stretch(a, b) += slopes[a] * pulled[b];
            inertia(a, b) += square * material.density * values.shape_value(a, q) * values.shape_value(b, q) *
                             values.JxW(q);
          }
      }
      matrix = 0;
      for (unsigned int k = 0; k < n; ++k)
        for (unsigned int l = 0; l < n; ++l)
        {
          const auto [i, a] = element.system_to_component_index(k);
          const auto [j, b] = element.system_to_component_index(l);
          matrix(k, l) = (i == j ? stretch(a, b) - inertia(a, b) : 0.) + axis[i] * axis[j] * inertia(a, b);
        }
      for (const unsigned int f : cell->face_indices())
        for (const SurfacePressure &load : model.pressures)
          if (cell->face(f)->at_boundary() && cell->face(f)->boundary_id() == load.boundary)
          {
            face_values.reinit(cell, f);
            add_pressure(face_values, element, load.pressure, matrix);
          }
      body.constraints.distribute_local_to_global(matrix, dofs, system.stiffness);
    }
    if constexpr (dim == 3)
      add_masses(attached_points(body), &AttachedPoint::stiffening, system.stiffness);
    system.stiffness.compress(VectorOperation::add);
    numbers.largest_stress = Utilities::MPI::max(numbers.largest_stress, body.communicator());
    numbers.largest_gradient = Utilities::MPI::max(numbers.largest_gradient, body.communicator());
    return numbers;
  }

  std::shared_ptr<const MaterialFlow> coriolis_of(const ElasticBody<3> &body, const SecondOrderSystem &system)
  {
    auto result = std::make_shared<MaterialFlow>();
    result->fixed.reinit(system.stiffness);
    const Tensor<1, 3> &axis = body.model.rotation.axis;
    Tensor<2, 3> across;
    for (unsigned int j = 0; j < 3; ++j)
    {
      Tensor<1, 3> unit;
      unit[j] = 1;
      const Tensor<1, 3> turned = cross_product_3d(axis, unit);
      for (unsigned int i = 0; i < 3; ++i)
        across[i][j] = turned[i];
    }
    const FiniteElement<3> &scalar = body.element.base_element(0);
    const unsigned int n = body.element.n_dofs_per_cell();
    FEValues<3> values(body.mapping, scalar,
                       cell_quadrature<3>(scalar.reference_cell(), n_gauss_points(body.mesh, scalar)),
                       update_values | update_JxW_values);
    FullMatrix<double> matrix(n, n), inertia(scalar.n_dofs_per_cell(), scalar.n_dofs_per_cell());
    std::vector<types::global_dof_index> dofs(n);
    for (const auto &cell : body.dof_handler.active_cell_iterators())
    {
      if (!cell->is_locally_owned())
        continue;
      values.reinit(typename Triangulation<3>::active_cell_iterator(cell));
      const double density = body.model.material_of(cell->material_id()).density;
      inertia = 0;
      for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
        for (unsigned int a = 0; a < inertia.m(); ++a)
          for (unsigned int b = 0; b < inertia.n(); ++b)
            inertia(a, b) += density * values.shape_value(a, q) * values.shape_value(b, q) * values.JxW(q);
      for (unsigned int k = 0; k < n; ++k)
        for (unsigned int l = 0; l < n; ++l)
        {
          const auto [i, a] = body.element.system_to_component_index(k);
          const auto [j, b] = body.element.system_to_component_index(l);
          matrix(k, l) = across[i][j] * inertia(a, b);
        }
      cell->get_dof_indices(dofs);
      body.constraints.distribute_local_to_global(matrix, dofs, result->fixed);
    }
    add_masses(attached_points(body), &AttachedPoint::coriolis, result->fixed);
    result->fixed.compress(VectorOperation::add);
    return result;
  }

  template PrestressNumbers add_prestress(const ElasticBody<2> &, const PETScWrappers::MPI::Vector &,
                                          SecondOrderSystem &);
  template PrestressNumbers add_prestress(const ElasticBody<3> &, const PETScWrappers::MPI::Vector &,
                                          SecondOrderSystem &);
} // namespace vibrocontact
