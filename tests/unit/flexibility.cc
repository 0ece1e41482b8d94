// Static flexibility: inertia relief against the closed form of the free bar, Schur complement against
// solves.

#include "reduction_bodies.h"

#include <vibrocontact/reduction/flexibility.h>

#include <gtest/gtest.h>

using namespace vibrocontact;
using namespace reduction_test;

namespace
{
  /// F . G F of a free bar under unit tension on one end, over L / (3 E A).
  double free_bar_ratio(const unsigned int n, const unsigned int degree)
  {
    BlockParameters parameters;
    parameters.length = 1;
    parameters.width = 0.05;
    parameters.height = 0.04;
    parameters.divisions_x = n;
    parameters.divisions_y = parameters.divisions_z = 1;
    parameters.held.clear();
    ElasticModel<3> model;
    model.material.poisson_ratio = 0;
    SurfaceTraction<3> traction;
    traction.boundary = make_block<3>(parameters, "bar", MPI_COMM_WORLD).boundary_id("right");
    const double area = parameters.width * parameters.height;
    traction.traction[0] = 1 / area;
    model.tractions.push_back(traction);
    const Body body = make_body(parameters, model, MPI_COMM_WORLD, 0, degree);
    Flexibility flexibility(*body.system);
    dealii::PETScWrappers::MPI::Vector u(body.system->load);
    flexibility.vmult(u, body.system->load);
    // the answer has no rigid part
    dealii::PETScWrappers::MPI::Vector mass_u(u);
    body.system->mass.vmult(mass_u, u);
    for (const auto &phi : flexibility.rigid_modes())
      EXPECT_LT(std::abs(phi * mass_u), 1e-10 * mass_u.l2_norm() * phi.l2_norm());
    return (u * body.system->load) * 3 * model.material.young_modulus * area / parameters.length;
  }

  double largest_difference(const DenseMatrix &a, const DenseMatrix &b,
                            const std::vector<unsigned int> &columns)
  {
    double difference = 0, scale = 0;
    for (unsigned int j = 0; j < columns.size(); ++j)
      for (unsigned int i = 0; i < a.m(); ++i)
      {
        difference = std::max(difference, std::abs(a(i, columns[j]) - b(i, j)));
        scale = std::max(scale, std::abs(a(i, columns[j])));
      }
    return difference / scale;
  }
} // namespace

TEST(FlexibilityMpi, FreeBarInertiaRelief)
{
  // The answer is a parabola along the bar: exact with quadratic elements, order 2 with linear ones.
  EXPECT_NEAR(free_bar_ratio(5, 2), 1., 1e-9);
  const double coarse = std::abs(free_bar_ratio(4, 1) - 1), fine = std::abs(free_bar_ratio(8, 1) - 1);
  EXPECT_GT(coarse, 1e-4);
  EXPECT_NEAR(coarse / fine, 4., 0.4);
}

TEST(FlexibilityMpi, SchurComplementAgainstSolves)
{
  for (const bool free : {false, true})
  {
    BlockParameters parameters;
    parameters.divisions_x = parameters.divisions_y = 4;
    if (free)
      parameters.held.clear();
    const Body body = make_body(parameters, ElasticModel<3>(), MPI_COMM_WORLD, 12);
    Flexibility flexibility(*body.system);
    const std::vector<unsigned int> columns{0, 5, 11, 12, 20, 23, 24, 30, 33, 35};
    const DenseMatrix w = flexibility.contact_compliance();
    EXPECT_LT(largest_difference(w, flexibility.contact_compliance_columns(columns, 4), columns), 1e-9)
        << free;

    // One right-hand side, against the product with the matrix itself.
    dealii::PETScWrappers::MPI::Vector f(body.system->locally_owned, body.system->communicator), u(f), r(f);
    for (const auto &[dof, weight] : body.system->trace.rows[3])
      if (f.in_local_range(dof))
        f(dof) = weight;
    f.compress(dealii::VectorOperation::insert);
    flexibility.vmult(u, f);
    const auto trace = contact_trace(body.system->trace, u);
    for (unsigned int i = 0; i < trace.size(); ++i)
      EXPECT_NEAR(trace[i], w(i, 3), 1e-9 * w(3, 3));
    body.system->stiffness.vmult(r, u);
    r -= f;
    if (free)
      for (const auto &phi : flexibility.rigid_modes())
      {
        dealii::PETScWrappers::MPI::Vector inertia(phi);
        body.system->mass.vmult(inertia, phi);
        r.add(phi * f, inertia);
      }
    EXPECT_LT(r.l2_norm(), 1e-9 * f.l2_norm()) << free;
  }
}
