// Matrices of a body: rigid motions cost no energy, linear fields are exact, the error falls with order 3.

#include <vibrocontact/fe/assemble_body.h>
#include <vibrocontact/fe/elastic_body.h>
#include <vibrocontact/scene/block.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/petsc_precondition.h>
#include <deal.II/lac/petsc_solver.h>
#include <deal.II/lac/solver_control.h>

#include <deal.II/grid/grid_tools.h>

#include <gtest/gtest.h>

#include <set>

using namespace vibrocontact;
using namespace dealii;

namespace
{
  /// A box of distorted cells with hanging nodes.
  template <int dim>
  BodyMesh<dim> distorted_block(const unsigned int n)
  {
    BlockParameters parameters;
    parameters.divisions_x = parameters.divisions_y = parameters.divisions_z = n;
    parameters.length = 1;
    parameters.width = 0.8;
    parameters.height = 0.6;
    BodyMesh<dim> mesh = make_block<dim>(parameters, "block", MPI_COMM_WORLD);
    GridTools::transform(
        [](const Point<dim> &p)
        {
          Point<dim> q = p;
          for (unsigned int d = 0; d < dim; ++d)
            q[d] += 0.04 * std::sin(7 * p[(d + 1) % dim] + 2 * p[d]);
          return q;
        },
        *mesh.triangulation);
    for (const auto &cell : mesh.triangulation->active_cell_iterators())
      if (cell->is_locally_owned() && cell->center()[0] < 0 && cell->center()[dim - 1] < -0.25)
        cell->set_refine_flag();
    mesh.triangulation->execute_coarsening_and_refinement();
    return mesh;
  }

  template <int dim>
  double rigid_residual()
  {
    ElasticModel<dim> model;
    const ElasticBody<dim> body(distorted_block<dim>(3), model, 2);
    const auto assembled = assemble_body(body);
    const SecondOrderSystem &system = *assembled;
    EXPECT_EQ(system.n_rigid_modes, dim == 3 ? 6u : 3u);
    double worst = 0;
    PETScWrappers::MPI::Vector force(body.locally_owned, body.communicator());
    for (const auto &motion : system.rigid_motions)
    {
      system.stiffness.vmult(force, motion);
      worst = std::max(worst, force.linfty_norm() / system.stiffness.linfty_norm());
    }
    return worst;
  }

  /// Relative L2 error of the solution with the boundary values of `exact` and its body force.
  double manufactured_error(const unsigned int n, const bool linear)
  {
    constexpr int dim = 3;
    ElasticModel<dim> model;
    model.material.young_modulus = 1;
    model.material.poisson_ratio = 0.3;
    const ElasticBody<dim> body(distorted_block<dim>(n), model, 2);
    const auto assembled = assemble_body(body);
    const SecondOrderSystem &system = *assembled;
    const double lambda = model.material.lambda(), mu = model.material.mu();

    // Either linear or u_i = sin(k . x + i), for which div sigma = -mu |k|^2 u - (lambda + mu) k (k . u).
    const Tensor<1, dim> k({2., -1.5, 1.});
    const auto exact = [&](const Point<dim> &x, const unsigned int i)
    { return linear ? 0.3 * i + (i + 1.) * x[0] - 2. * x[1] + (i * i) * x[2] : std::sin(k * x + i); };
    const auto force = [&](const Point<dim> &x, const unsigned int i)
    {
      if (linear)
        return 0.;
      double k_u = 0;
      for (unsigned int j = 0; j < dim; ++j)
        k_u += k[j] * exact(x, j);
      return mu * k.norm_square() * exact(x, i) + (lambda + mu) * k[i] * k_u;
    };

    // Right-hand side, and boundary values imposed by penalty-free elimination: solve for the interior dofs.
    const IndexSet boundary = DoFTools::extract_boundary_dofs(body.dof_handler);
    PETScWrappers::MPI::Vector rhs(body.locally_owned, body.communicator()), u(rhs), r(rhs);
    FEValues<dim> values(body.mapping, body.element, QGauss<dim>(5),
                         update_values | update_quadrature_points | update_JxW_values);
    FEValues<dim> nodes(body.mapping, body.element, Quadrature<dim>(body.element.get_unit_support_points()),
                        update_quadrature_points);
    std::vector<types::global_dof_index> dofs(body.element.n_dofs_per_cell());
    Vector<double> cell_rhs(dofs.size());
    std::vector<PetscInt> fixed;
    std::set<types::global_dof_index> seen;
    for (const auto &cell : body.dof_handler.active_cell_iterators())
    {
      values.reinit(cell);
      nodes.reinit(cell);
      cell->get_dof_indices(dofs);
      for (unsigned int a = 0; a < dofs.size(); ++a)
      {
        const unsigned int c = body.element.system_to_component_index(a).first;
        cell_rhs(a) = 0;
        for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
          cell_rhs(a) += force(values.quadrature_point(q), c) * values.shape_value(a, q) * values.JxW(q);
        if (boundary.is_element(dofs[a]) && !body.constraints.is_constrained(dofs[a]) &&
            seen.insert(dofs[a]).second)
        {
          u(dofs[a]) = exact(nodes.quadrature_point(a), c);
          fixed.push_back(dofs[a]);
        }
      }
      body.constraints.distribute_local_to_global(cell_rhs, dofs, rhs);
    }
    rhs.compress(VectorOperation::add);
    u.compress(VectorOperation::insert);
    PETScWrappers::MPI::SparseMatrix matrix;
    matrix.reinit(system.stiffness);
    matrix.copy_from(system.stiffness);
    MatZeroRowsColumns(matrix, fixed.size(), fixed.data(), 1., u, rhs);
    SolverControl control(5000, 1e-13 * rhs.l2_norm());
    PETScWrappers::SolverCG cg(control);
    cg.solve(matrix, u, rhs, PETScWrappers::PreconditionJacobi(matrix));
    const auto complete = body.complete(u);

    FEValues<dim> fine(body.mapping, body.element, QGauss<dim>(5),
                       update_values | update_quadrature_points | update_JxW_values);
    std::vector<Vector<double>> solution(fine.n_quadrature_points, Vector<double>(dim));
    double error = 0, norm = 0;
    for (const auto &cell : body.dof_handler.active_cell_iterators())
    {
      fine.reinit(cell);
      fine.get_function_values(complete, solution);
      for (unsigned int q = 0; q < fine.n_quadrature_points; ++q)
        for (unsigned int i = 0; i < dim; ++i)
        {
          const double e = exact(fine.quadrature_point(q), i);
          error += Utilities::fixed_power<2>(solution[q](i) - e) * fine.JxW(q);
          norm += e * e * fine.JxW(q);
        }
    }
    return std::sqrt(error / norm);
  }
} // namespace

TEST(Elasticity, rigid_motions_cost_no_energy)
{
  EXPECT_LT(rigid_residual<2>(), 1e-13);
  EXPECT_LT(rigid_residual<3>(), 1e-13);
}

TEST(Elasticity, patch_test_on_distorted_cells_with_hanging_nodes)
{
  EXPECT_LT(manufactured_error(2, true), 1e-10);
}

TEST(Elasticity, third_order_in_l2_with_hanging_nodes)
{
  const double coarse = manufactured_error(4, false), fine = manufactured_error(8, false);
  std::cout << "errors " << coarse << " " << fine << " order " << std::log2(coarse / fine) << std::endl;
  EXPECT_GT(std::log2(coarse / fine), 2.9);
}

TEST(Elasticity, mass_load_and_constrained_rows)
{
  ElasticModel<3> model;
  model.gravity[2] = -10;
  BodyMesh<3> mesh = distorted_block<3>(2);
  model.held = {mesh.boundary_id("bottom")};
  const ElasticBody<3> body(std::move(mesh), model, 2);
  const auto assembled = assemble_body(body);
  const SecondOrderSystem &system = *assembled;
  EXPECT_EQ(system.n_rigid_modes, 0u);
  EXPECT_NEAR(system.total_mass / 7800, 0.48, 0.05);
  for (const auto dof : body.locally_owned)
    if (body.constraints.is_constrained(dof))
    {
      EXPECT_EQ(system.mass.diag_element(dof), 0.);
      EXPECT_GT(system.stiffness.diag_element(dof), 0.);
    }
}
