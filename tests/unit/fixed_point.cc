// The fixed point's rho belongs to the points in contact: free points around them must not slow it down.

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/contact/contact_solvers.h>

#include <gtest/gtest.h>

using namespace vibrocontact;

TEST(FixedPoint, FreePointsDoNotSlowItDown)
{
  // A body that moves as a whole under a force anywhere (compliance 0.5 between all points) and gives by 2 at
  // each point; ten points touch. Closed form: N (2 + 10 * 0.5) = approach.
  unsigned int iterations[2];
  for (const unsigned int n : {10u, 200u})
  {
    DenseMatrix A(3 * n);
    for (unsigned int i = 0; i < 3 * n; ++i)
      for (unsigned int j = 0; j < 3 * n; ++j)
        A(i, j) = (i == j ? 2 : 0) + (i < n && j < n ? 0.5 : 0);
    ContactProblem problem;
    problem.A = std::make_shared<DenseContactOperator>(std::move(A));
    problem.b.reinit(3 * n);
    for (unsigned int i = 0; i < n; ++i)
    {
      problem.b[i] = i < 10 ? 0 : 100;
      problem.b[n + i] = 1e-3 * i;
    }
    problem.mu.assign(n, 0.3);
    problem.approach = 1;
    ContactSolverParameters parameters;
    parameters.method = "fixed point";
    const ContactSolution s = create_contact_solver(parameters)->solved(problem);
    EXPECT_TRUE(s.converged) << n;
    for (unsigned int i = 0; i < 10; ++i)
      EXPECT_NEAR(s.R[i], 1. / 7, 1e-10) << n;
    iterations[n == 200] = s.iterations;
  }
  // with rho of the whole grid it would take fifteen times as many
  EXPECT_LE(iterations[1], iterations[0] + 200);
}

TEST(FixedPoint, FindsWhereSlipFollowsNoForces)
{
  // a body that slides without rolling: N (2 + 4 * 0.5) = approach, friction against the slip
  const unsigned int n = 4;
  DenseMatrix A(3 * n);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
      A(i, j) = (i == j ? 2 : 0) + 0.5;
  ContactProblem problem;
  problem.A = std::make_shared<DenseContactOperator>(std::move(A));
  problem.b.reinit(3 * n);
  for (unsigned int i = 0; i < n; ++i)
  {
    problem.b[n + i] = 3e-3;
    problem.b[2 * n + i] = -4e-3;
  }
  problem.mu.assign(n, 0.3);
  problem.approach = 1;
  for (const std::string method : {"fixed point", "semi-smooth newton"})
  {
    ContactSolverParameters parameters;
    parameters.method = method;
    const ContactSolution s = create_contact_solver(parameters)->solved(problem);
    EXPECT_TRUE(s.converged) << method;
    for (unsigned int i = 0; i < n; ++i)
    {
      EXPECT_NEAR(s.R[i], 0.25, 1e-10) << method;
      EXPECT_NEAR(s.R[n + i], -0.3 * 0.25 * 0.6, 1e-10) << method;
      EXPECT_NEAR(s.R[2 * n + i], 0.3 * 0.25 * 0.8, 1e-10) << method;
    }
  }
}

TEST(FixedPoint, GapsBeyondAllNumbersEndInASentence)
{
  const unsigned int n = 4;
  DenseMatrix A(3 * n);
  for (unsigned int i = 0; i < 3 * n; ++i)
    A(i, i) = 1;
  ContactProblem problem;
  problem.A = std::make_shared<DenseContactOperator>(std::move(A));
  problem.b.reinit(3 * n);
  for (unsigned int i = 0; i < n; ++i)
    problem.b[i] = 1e308;
  problem.mu.assign(n, 0.3);
  problem.normal_force = 1;
  ContactSolution start;
  start.R.reinit(3 * n);
  start.approach = -1e308; // the gaps are infinite
  ContactSolverParameters parameters;
  parameters.method = "fixed point";
  EXPECT_THROW(create_contact_solver(parameters)->solved(problem, start), ConvergenceError);
}
