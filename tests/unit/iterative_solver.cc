// Iterative solves of the stiffness against direct ones: compliance and modes, held and free; what does not converge.

#include "reduction_bodies.h"

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/reduction/compute_modes.h>
#include <vibrocontact/reduction/conjugate_gradients.h>
#include <vibrocontact/reduction/reduction_cost.h>
#include <vibrocontact/scene/mesh_compactness.h>

#include <gtest/gtest.h>

using namespace vibrocontact;
using namespace reduction_test;

namespace
{
  BlockParameters block(const unsigned int nx, const unsigned int ny, const unsigned int nz, const bool free)
  {
    BlockParameters parameters;
    parameters.divisions_x = nx;
    parameters.divisions_y = ny;
    parameters.divisions_z = nz;
    if (free)
      parameters.held.clear();
    return parameters;
  }
} // namespace

TEST(IterativeSolverMpi, AnswersAreThoseOfTheDirectOne)
{
  for (const bool free : {false, true})
  {
    const Body body = make_body(block(4, 3, 3, free), ElasticModel<3>(), MPI_COMM_WORLD, 12);
    Flexibility direct(*body.system), iterative(*body.system, StiffnessSolver::iterative);
    DenseMatrix difference = direct.contact_compliance();
    const double size = difference.linfty_norm();
    difference.add(-1., iterative.contact_compliance());
    EXPECT_LT(difference.linfty_norm(), 1e-9 * size) << free;

    ModeParameters parameters;
    parameters.count = 8;
    const Modes expected = compute_modes(*body.system, direct, parameters),
                modes = compute_modes(*body.system, iterative, parameters);
    ASSERT_EQ(modes.omega.size(), expected.omega.size());
    EXPECT_EQ(modes.n_rigid_modes, free ? 6u : 0u);
    for (unsigned int k = modes.n_rigid_modes; k < modes.omega.size(); ++k)
    {
      EXPECT_NEAR(modes.omega[k], expected.omega[k], 1e-9 * expected.omega[k]) << k;
      dealii::PETScWrappers::MPI::Vector inertia(modes.shapes[k]);
      body.system->mass.vmult(inertia, expected.shapes[k]);
      EXPECT_NEAR(std::abs(modes.shapes[k] * inertia), 1., 1e-7) << k;
    }
    EXPECT_LT(modes.orthonormality_error, 1e-9);
  }
}

TEST(IterativeSolverMpi, ModesByFrequencyCannotBeCounted)
{
  const Body body = make_body(block(2, 2, 2, false), ElasticModel<3>(), MPI_COMM_WORLD, 0);
  Flexibility iterative(*body.system, StiffnessSolver::iterative);
  ModeParameters parameters;
  parameters.upper_frequency = 1e5;
  EXPECT_THROW(compute_modes(*body.system, iterative, parameters), InputError);
}

// A bar 1,000 times as long as thick has some digits left in double precision, none in single.
TEST(IterativeSolverMpi, TooSlenderForSinglePrecisionIsSaid)
{
  BlockParameters parameters = block(100, 1, 1, false);
  parameters.length = 1;
  parameters.width = parameters.height = 1e-3;
  parameters.held = {"left"};
  const Body body = make_body(parameters, ElasticModel<3>(), MPI_COMM_WORLD, 0);
  EXPECT_NO_THROW(Flexibility direct(*body.system));
  EXPECT_THROW(Flexibility iterative(*body.system, StiffnessSolver::iterative), ConvergenceError);
}

namespace
{
  ColumnOperator diagonal(const std::function<double(unsigned int)> &entry)
  {
    return [entry](const std::vector<double> &in, const unsigned int n_columns)
    {
      std::vector<double> out = in;
      const std::size_t n = in.size() / n_columns;
      for (std::size_t i = 0; i < in.size(); ++i)
        out[i] *= entry(i % n);
      return out;
    };
  }
} // namespace

TEST(ConjugateGradients, EndInAsManyStepsAsEigenvaluesOrSayThatTheyDoNot)
{
  const ColumnOperator matrix = diagonal([](const unsigned int i) { return 1. + i % 3; }),
                       identity = diagonal([](unsigned int) { return 1.; });
  // the second column is zero, the third an eigenvector
  std::vector<double> b(30, 0.);
  for (unsigned int i = 0; i < 10; ++i)
    b[i] = i + 1;
  b[21] = 4;
  std::vector<double> x = b;
  const auto result = conjugate_gradients(MPI_COMM_SELF, matrix, identity, x, 3, 3., 1e-12, 10);
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(result.n_iterations, 3u);
  EXPECT_LT(result.measured, 1e-12);
  for (unsigned int i = 0; i < 30; ++i)
    EXPECT_NEAR(x[i], b[i] / (1. + i % 10 % 3), 1e-12);

  x = b;
  EXPECT_FALSE(conjugate_gradients(MPI_COMM_SELF, matrix, identity, x, 3, 3., 1e-12, 2).converged);
  for (const double wrong : {-1., std::nan("")})
  {
    x = b;
    const ColumnOperator preconditioner = diagonal([wrong](unsigned int) { return wrong; });
    EXPECT_FALSE(conjugate_gradients(MPI_COMM_SELF, matrix, preconditioner, x, 3, 3., 1e-12, 10).converged);
  }
}

TEST(MeshCompactness, OfACubeIsOneAndOfABarThatOfItsSection)
{
  const auto compactness = [](const BlockParameters &parameters)
  { return mesh_compactness(*make_block<3>(parameters, "block", MPI_COMM_SELF).triangulation); };
  EXPECT_NEAR(compactness(block(20, 20, 20, false)), 1., 0.05);
  // levels of 16 cells on 400 along the bar
  EXPECT_NEAR(compactness(block(400, 4, 4, false)), 4. * 6400 / (0.728 * std::pow(6400., 4. / 3)), 0.01);
}

TEST(ReductionCost, OfIterativeSolvesTakesLessMemoryAndMoreTimePerColumn)
{
  const ReductionSize size{1e6, 1, 363, 20, false};
  const ReductionCost direct = reduction_cost(size),
                      iterative = reduction_cost(size, StiffnessSolver::iterative);
  EXPECT_GT(direct.peak, 24e9);
  EXPECT_LT(iterative.peak, 24e9);
  EXPECT_GT(iterative.stages[2].seconds, direct.stages[2].seconds);
}
