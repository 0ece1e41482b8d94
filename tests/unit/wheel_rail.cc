// Built-in wheel and rail: mass, area, moments and surface heights against the values of their outlines.

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/fe/assemble_body.h>
#include <vibrocontact/fe/elastic_body.h>
#include <vibrocontact/fe/trace_assembly.h>
#include <vibrocontact/scene/rail.h>
#include <vibrocontact/scene/wheel.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <gtest/gtest.h>

using namespace vibrocontact;
using namespace dealii;

namespace
{
  ContactGrid grid(const unsigned int half_x, const unsigned int half_y, const double spacing)
  {
    ContactGrid g;
    g.n_x = 2 * half_x + 1;
    g.n_y = 2 * half_y + 1;
    g.spacing_x = g.spacing_y = spacing;
    g.x_first = -(half_x * spacing);
    g.y_first = -(half_y * spacing);
    return g;
  }

  /// Volume, centre, second moments about the centre (of volume), smallest Jacobian over mean at Gauss
  /// points.
  struct Moments
  {
    double volume = 0, smallest_jacobian = 1e300;
    Tensor<1, 3> centre;
    Tensor<1, 3> second;
  };

  Moments moments(const BodyMesh<3> &mesh)
  {
    Moments m;
    const MappingQ<3> mapping(mesh.geometry_degree);
    const FE_Q<3> element(1);
    FEValues<3> values(mapping, element, QGauss<3>(4), update_quadrature_points | update_JxW_values);
    Tensor<1, 3> raw;
    for (const auto &cell : mesh.triangulation->active_cell_iterators())
      if (cell->is_locally_owned())
      {
        values.reinit(cell);
        double cell_volume = 0, smallest = 1e300;
        for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
        {
          const Point<3> x = values.quadrature_point(q);
          m.volume += values.JxW(q);
          cell_volume += values.JxW(q);
          smallest = std::min(smallest, values.JxW(q) / values.get_quadrature().weight(q));
          for (unsigned int d = 0; d < 3; ++d)
          {
            m.centre[d] += x[d] * values.JxW(q);
            raw[d] += x[d] * x[d] * values.JxW(q);
          }
        }
        m.smallest_jacobian = std::min(m.smallest_jacobian, smallest / cell_volume);
      }
    m.centre /= m.volume;
    for (unsigned int d = 0; d < 3; ++d)
      m.second[d] = raw[d] - m.volume * m.centre[d] * m.centre[d];
    return m;
  }
} // namespace

TEST(Wheel, mass_and_shape)
{
  WheelParameters parameters;
  const BodyMesh<3> mesh = make_wheel(parameters, 0., nullptr, "wheel", MPI_COMM_WORLD);
  const Moments m = moments(mesh);
  std::cout << "mass " << 7800 * m.volume << " kg, cells " << mesh.triangulation->n_global_active_cells()
            << ", smallest relative Jacobian " << m.smallest_jacobian << std::endl;
  EXPECT_NEAR(7800 * m.volume / 314.86, 1, 2e-4);
  EXPECT_GT(m.smallest_jacobian, 0.05);
  EXPECT_NEAR(m.centre[0], 0, 1e-6);
  EXPECT_NEAR(m.centre[2], 0.46, 1e-5);
}

TEST(Wheel, surface_height_over_a_grid_beside_the_taping_line)
{
  WheelParameters parameters;
  parameters.coarse_division = 0.15;
  parameters.growth = 2;
  const ContactGrid g = grid(8, 5, 0.001);
  const ElasticBody<3> body(make_wheel(parameters, 0.0123, &g, "wheel", MPI_COMM_WORLD), ElasticModel<3>(),
                            2);
  const auto system = assemble_body(body, &g);
  for (unsigned int i = 0; i < g.n_points(); ++i)
  {
    // Mean of 0.46 - sqrt(0.46^2 - x^2) over the cell.
    const double x = g.x(i);
    EXPECT_NEAR(1e6 * system->trace.surface_height[i], 1e6 * (x * x + 1e-6 / 12) / 0.92, 0.03);
  }
  EXPECT_THROW(make_wheel(parameters, 0.07, nullptr, "wheel", MPI_COMM_WORLD), InputError);
}

TEST(Rail, area_and_moments_of_the_section)
{
  RailParameters parameters;
  parameters.length = 0.4;
  const Moments m = moments(make_rail(parameters, nullptr, "rail", MPI_COMM_WORLD));
  const double area = 1e4 * m.volume / 0.4, iy = 1e8 * m.second[2] / 0.4, iz = 1e8 * m.second[1] / 0.4;
  std::cout << "area " << area << " cm2 (" << 100 * (area / 76.71 - 1) << " %), centroid "
            << 1e3 * m.centre[2] + 172 << " mm, Iy " << iy << " (" << 100 * (iy / 3038.8 - 1) << " %), Iz "
            << iz << " (" << 100 * (iz / 512.4 - 1) << " %), smallest relative Jacobian "
            << m.smallest_jacobian << std::endl;
  EXPECT_NEAR(area / 76.71, 1, 3e-3);
  EXPECT_NEAR(1e3 * m.centre[2] + 172, 80.91, 0.1);
  EXPECT_NEAR(iy / 3038.8, 1, 3e-3);
  EXPECT_NEAR(iz / 512.4, 1, 3e-3);
  EXPECT_GT(m.smallest_jacobian, 0.05);
}

TEST(Rail, supports_carry_the_weight_and_the_crown_is_round)
{
  RailParameters parameters;
  parameters.length = 1.4;
  parameters.anechoic_lengths = {0.1, 0.2};
  const ContactGrid g = grid(8, 6, 0.001);
  BodyMesh<3> mesh = make_rail(parameters, &g, "rail", MPI_COMM_WORLD);
  ElasticModel<3> model;
  add_supports(model, parameters, mesh);
  EXPECT_EQ(model.springs[0].segments.size(), 2u);
  EXPECT_DOUBLE_EQ(model.material_of(2).loss_factor, 1);
  const ElasticBody<3> body(std::move(mesh), model, 2);
  const auto system = assemble_body(body, &g);
  EXPECT_EQ(system->n_rigid_modes, 0u);
  EXPECT_TRUE(system->has_loss);
  // A vertical translation stretches both pads and nothing else.
  PETScWrappers::MPI::Vector lift = rigid_motions(body)[2], force(lift);
  lift /= lift.linfty_norm();
  system->stiffness.vmult(force, lift);
  EXPECT_NEAR(lift * force / (2 * 180e6), 1, 1e-9);
  for (unsigned int i = 0; i < g.n_points(); ++i)
  {
    const double y = g.y(i);
    EXPECT_NEAR(1e6 * system->trace.surface_height[i], -1e6 * (y * y + 1e-6 / 12) / 0.6, 0.05) << y;
  }
}

TEST(Wheel, default_mesh_at_the_contact)
{
  // The default wheel with its refined patch: size, and the trace's weights on a grid of 1 mm; nothing is
  // assembled or factorised here (verification/wheel_frequencies does).
  const ContactGrid g = grid(14, 10, 0.001);
  BodyMesh<3> mesh = make_wheel(WheelParameters(), 0., &g, "wheel", MPI_COMM_WORLD);
  ElasticModel<3> model;
  model.held = {mesh.boundary_id("bore")};
  const ElasticBody<3> body(std::move(mesh), model, 2);
  EXPECT_GT(body.dof_handler.n_dofs(), 200000u);
  EXPECT_LT(body.dof_handler.n_dofs(), 260000u);
  const ContactTrace trace = make_contact_trace(body, g);
  for (unsigned int i = 0; i < g.n_points(); ++i)
  {
    double sum = 0;
    for (const auto &[dof, weight] : trace.rows[i])
      sum += weight;
    EXPECT_NEAR(sum, 1, 1e-12);
    const double x = g.x(i);
    EXPECT_NEAR(1e6 * trace.surface_height[i],
                1e6 * (0.46 - std::sqrt(0.46 * 0.46 - x * x) + 1e-6 / (24 * 0.46)), 0.01);
  }
}
