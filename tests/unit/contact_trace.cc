// The trace P_c: weights sum to one, linear fields are met exactly, uniform pressure arrives as the
// consistent load.

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/fe/assemble_body.h>
#include <vibrocontact/fe/elastic_body.h>
#include <vibrocontact/scene/block.h>

#include <deal.II/fe/fe_values.h>

#include <gtest/gtest.h>

using namespace vibrocontact;
using namespace dealii;

namespace
{
  /// Block with 2 mm cells at the contact, hanging nodes below and around.
  BodyMesh<3> block(const double offset)
  {
    BlockParameters parameters;
    parameters.length = parameters.width = 0.04;
    parameters.height = 0.016;
    parameters.divisions_x = parameters.divisions_y = 10;
    parameters.divisions_z = 4;
    parameters.offset_x = parameters.offset_y = offset;
    BodyMesh<3> mesh = make_block<3>(parameters, "block", MPI_COMM_WORLD);
    for (const auto &cell : mesh.triangulation->active_cell_iterators())
      if (cell->is_locally_owned() && std::abs(cell->center()[0]) < 0.013 &&
          std::abs(cell->center()[1]) < 0.013 && cell->center()[2] > -0.004)
        cell->set_refine_flag();
    mesh.triangulation->execute_coarsening_and_refinement();
    return mesh;
  }

  ContactGrid grid(const unsigned int half, const double spacing)
  {
    ContactGrid g;
    g.n_x = g.n_y = 2 * half + 1;
    g.spacing_x = g.spacing_y = spacing;
    g.x_first = g.y_first = -(half * spacing);
    return g;
  }

  /// A linear field, and the largest error of its cell means.
  double linear_error(const ElasticBody<3> &body, const ContactTrace &trace)
  {
    const Tensor<1, 3> a({3., -2., 5.});
    std::vector<double> field(body.dof_handler.n_dofs(), 0.);
    FEValues<3> nodes(body.mapping, body.element, Quadrature<3>(body.element.get_unit_support_points()),
                      update_quadrature_points);
    std::vector<types::global_dof_index> dofs(body.element.n_dofs_per_cell());
    for (const auto &cell : body.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
      {
        nodes.reinit(cell);
        cell->get_dof_indices(dofs);
        for (unsigned int k = 0; k < dofs.size(); ++k)
          if (body.locally_owned.is_element(dofs[k]))
            field[dofs[k]] =
                (1. + body.element.system_to_component_index(k).first) * (a * nodes.quadrature_point(k));
      }
    std::vector<double> all(field.size());
    Utilities::MPI::sum(field, MPI_COMM_WORLD, all);
    double error = 0;
    const unsigned int n = trace.grid.n_points();
    for (unsigned int c = 0; c < 3; ++c)
      for (unsigned int i = 0; i < n; ++i)
      {
        double mean = 0;
        for (const auto &[dof, weight] : trace.rows[contact_row(n, c, i)])
          mean += weight * all[dof];
        const double factor = c == 0 ? 3 : c;
        const double exact =
            factor * (a[0] * trace.grid.x(i) + a[1] * trace.grid.y(i) + a[2] * trace.surface_height[i]);
        error = std::max(error, std::abs(mean - exact));
      }
    return error;
  }
} // namespace

TEST(ContactTraceMpi, means_of_linear_fields_are_exact_on_any_grid)
{
  for (const double offset : {0., 0.00037})
  {
    const ElasticBody<3> body(block(offset), ElasticModel<3>(), 2);
    for (const double spacing : {0.001, 0.0013})
    {
      const ContactGrid g = grid(6, spacing);
      const auto system = assemble_body(body, &g);
      EXPECT_LT(linear_error(body, system->trace), 1e-14) << offset << " " << spacing;
    }
  }
}

TEST(ContactTraceMpi, uniform_pressure_arrives_as_consistent_load)
{
  // The grid of 2 mm cells covers the whole top: P_c^T (A p) is the load of the same traction on the
  // boundary.
  for (const unsigned int degree : {2, 3})
  {
    BlockParameters parameters;
    parameters.length = parameters.width = 0.04;
    parameters.height = 0.012;
    parameters.divisions_x = parameters.divisions_y = 10;
    BodyMesh<3> mesh = make_block<3>(parameters, "block", MPI_COMM_WORLD);
    ElasticModel<3> model;
    model.tractions.push_back({mesh.boundary_id("top"), Tensor<1, 3>({2., 3., -7.})});
    const ElasticBody<3> body(std::move(mesh), model, degree);
    ContactGrid g;
    g.n_x = g.n_y = 20;
    g.spacing_x = g.spacing_y = 0.002;
    g.x_first = g.y_first = -0.019;
    const auto system = assemble_body(body, &g);
    PETScWrappers::MPI::Vector spread(body.locally_owned, MPI_COMM_WORLD);
    const double traction[3] = {-7, 2, 3};
    for (unsigned int c = 0; c < 3; ++c)
      for (unsigned int i = 0; i < g.n_points(); ++i)
        for (const auto &[dof, weight] : system->trace.rows[contact_row(g.n_points(), c, i)])
          if (body.locally_owned.is_element(dof))
            spread(dof) += g.cell_area() * traction[c] * weight;
    spread.compress(VectorOperation::add);
    spread -= system->load;
    EXPECT_LT(spread.linfty_norm() / system->load.linfty_norm(), 1e-12);
  }
}

TEST(ContactTraceMpi, wrong_grids_are_refused)
{
  const ElasticBody<3> body(block(0), ElasticModel<3>(), 2);
  const auto refused = [&](const ContactGrid &g, const std::string &part)
  {
    try
    {
      assemble_body(body, &g);
    }
    catch (const InputError &error)
    {
      return std::string(error.what()).find(part) != std::string::npos;
    }
    return false;
  };
  EXPECT_TRUE(refused(grid(21, 0.001), "leaves the surface"));
  EXPECT_TRUE(refused(grid(6, 0.0005), "too fine"));
}

TEST(ContactTraceMpi, means_are_exact_across_hanging_nodes)
{
  const ElasticBody<3> body(block(0), ElasticModel<3>(), 2);
  const ContactGrid g = grid(7, 0.002);
  EXPECT_LT(linear_error(body, assemble_body(body, &g)->trace), 1e-14);
}

TEST(ContactTrace, line_contact_of_a_plane_body)
{
  BlockParameters parameters;
  parameters.divisions_x = 10;
  const ElasticBody<2> body(make_block<2>(parameters, "plane", MPI_COMM_WORLD), ElasticModel<2>(), 2);
  ContactGrid g;
  g.n_x = 5;
  g.n_y = 1;
  g.spacing_x = 0.005;
  g.spacing_y = 1;
  g.x_first = -0.01;
  const auto system = assemble_body(body, &g);
  for (unsigned int i = 0; i < 5; ++i)
  {
    double sum = 0;
    for (const auto &entry : system->trace.rows[contact_row(5, 0, i)])
      sum += entry.second;
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_TRUE(system->trace.rows[contact_row(5, 2, i)].empty());
    EXPECT_NEAR(system->trace.surface_height[i], 0, 1e-15);
  }
}
