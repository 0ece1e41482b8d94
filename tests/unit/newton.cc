// Newton's solver where its linear systems fail: singular matrices, nothing in touch, numbers that are not
// finite. Truth: closed forms, and the fixed point.

#include "pressed_block.h"

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/contact/contact_solvers.h>
#include <vibrocontact/contact/newton.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace vibrocontact;

namespace
{
  /// Points that do not feel each other: compliance 2 everywhere, gaps 0, 0.1, 0.2, ...
  ContactProblem springs(const unsigned int n, const double coupling = 0)
  {
    DenseMatrix A(3 * n);
    for (unsigned int i = 0; i < 3 * n; ++i)
      for (unsigned int j = 0; j < 3 * n; ++j)
        A(i, j) = i == j ? 2 : i / n == j / n ? coupling : 0;
    ContactProblem problem;
    problem.title = "springs";
    problem.A = std::make_shared<DenseContactOperator>(std::move(A));
    problem.b.reinit(3 * n);
    for (unsigned int i = 0; i < n; ++i)
      problem.b[i] = 0.1 * i;
    problem.mu.assign(n, 0.3);
    return problem;
  }
} // namespace

TEST(Newton, BeginsAgainWhereNothingTouches)
{
  // A start without forces and far apart: no point answers to the approach, the fallback closes the gap.
  // Then forces F on the first two points: 2 N1 = d, 2 N2 = d - 0.1.
  ContactProblem problem = springs(4);
  problem.normal_force = 0.1;
  ContactSolution start;
  start.R.reinit(12);
  start.approach = -1;
  const ContactSolution s = NewtonSolver({}).solved(problem, start);
  EXPECT_TRUE(s.converged);
  EXPECT_GE(s.fallbacks, 1u);
  EXPECT_NEAR(s.R[0], 0.075, 1e-10);
  EXPECT_NEAR(s.R[1], 0.025, 1e-10);
  EXPECT_NEAR(s.approach, 0.15, 1e-10);
  EXPECT_EQ(s.status[2], ContactStatus::open);
}

// In a march a kept matrix is not to blame where no point touches and none was asked.
TEST(Newton, NothingTouchesInAMarch)
{
  ContactProblem problem = springs(4);
  problem.normal_force = 0.1;
  NewtonSolver solver({});
  ContactSolution state;
  for (const double away : {0., 0.01, 0.02, 1., -2., 3.})
  {
    for (unsigned int i = 0; i < 4; ++i)
    {
      problem.b[i] = away + 0.1 * i;
      problem.b[4 + i] = 0.3 + 0.01 * away;
    }
    solver.solve(problem, state);
    ASSERT_TRUE(state.converged) << away;
    EXPECT_NEAR(state.R[0], 0.075, 1e-9) << away;
    EXPECT_NEAR(state.R[1], 0.025, 1e-9) << away;
    EXPECT_NEAR(state.approach, away + 0.15, 1e-9) << away;
  }
}

TEST(Newton, SingularMatrixGoesToTheFallback)
{
  // Two points whose normal compliance has rank one share a given approach in any proportion; the sum is
  // determined: 2 (N1 + N2) = 0.3.
  ContactProblem problem = springs(2, 2.);
  problem.b[1] = 0;
  problem.approach = 0.3;
  problem.mu = {0, 0};
  const ContactSolution s = NewtonSolver({}).solved(problem);
  for (const double x : s.R)
    EXPECT_TRUE(std::isfinite(x));
  EXPECT_TRUE(s.converged);
  EXPECT_NEAR(s.R[0] + s.R[1], 0.15, 1e-10);
}

TEST(Newton, NoContactIsAnAnswer)
{
  // also from forces that all have to go
  ContactProblem problem = springs(3);
  problem.approach = -0.5;
  ContactSolution pressed;
  pressed.R.reinit(9);
  pressed.R[0] = 0.01;
  for (const ContactSolution &start : {ContactSolution(), pressed})
  {
    const ContactSolution s = NewtonSolver({}).solved(problem, start);
    EXPECT_TRUE(s.converged);
    EXPECT_EQ(s.R.l2_norm(), 0.);
    EXPECT_NEAR(s.y[0], 0.5, 1e-14);
  }
}

TEST(Newton, NotANumberStaysOutside)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ContactProblem problem = springs(4);
  problem.normal_force = 0.1;
  // a start that is not finite is none
  ContactSolution start;
  start.R.reinit(12);
  start.R[5] = nan;
  for (const ContactSolverEntry &entry : contact_solvers())
  {
    if (entry.takes && !entry.takes(problem))
      continue;
    ContactSolverParameters parameters;
    parameters.method = entry.name;
    const auto solver = create_contact_solver(parameters);
    const ContactSolution s = solver->solved(problem, start);
    EXPECT_TRUE(s.converged) << entry.name;
    EXPECT_NEAR(s.R[0], 0.075, 1e-10) << entry.name;
    // a problem that is not finite has no answer
    ContactProblem broken = problem;
    broken.b[1] = nan;
    EXPECT_THROW(solver->solved(broken), ConvergenceError) << entry.name;
  }
}

namespace
{
  /// A block of 10 by 10 points that stays pressed, whose sliding velocity goes to and fro.
  class SlidingBlock
  {
  public:
    SlidingBlock()
    {
      problem.title = "to and fro";
      problem.A = pressed_block::response(10, 10);
      n = problem.n_points();
      problem.b.reinit(3 * n);
      problem.mu.assign(n, 0.3);
      problem.approach = 1e-5;
    }

    const ContactProblem &at(const double angle)
    {
      for (unsigned int i = 0; i < n; ++i)
      {
        problem.b[n + i] = 0.02 * (1 + 0.1 * std::sin(1. * i)) * std::cos(angle);
        problem.b[2 * n + i] = 0.1 + 0.11 * std::sin(angle) + 0.005 * std::cos(2. * i);
      }
      return problem;
    }

  private:
    unsigned int n = 0;
    ContactProblem problem;
  };

  void expect_solution_of_a_new_solver(const ContactProblem &problem,
                                       const ContactSolverParameters &parameters,
                                       const ContactSolution &state)
  {
    const ContactSolution alone = NewtonSolver(parameters).solved(problem);
    ASSERT_TRUE(alone.converged);
    DenseVector difference(state.R);
    difference -= alone.R;
    EXPECT_LT(difference.l2_norm(), 3e-9 * alone.R.l2_norm());
    EXPECT_EQ(state.status, alone.status);
    EXPECT_NEAR(state.approach, alone.approach, 1e-8 * std::abs(alone.approach));
  }
} // namespace

// Factors of a problem by itself are in double precision; the next one makes its own in single precision, which serve from then on.
TEST(Newton, FactorsOfTheFirstProblemServeItAlone)
{
  SlidingBlock block;
  ContactSolverParameters parameters;
  parameters.tolerance = 1e-9;
  NewtonSolver solver(parameters);
  ContactSolution state;
  unsigned int factorisations[4];
  for (unsigned int k = 0; k < 4; ++k)
  {
    solver.solve(block.at(0.3 + 1e-6 * k), state);
    ASSERT_TRUE(state.converged) << k;
    factorisations[k] = state.factorisations;
  }
  EXPECT_GT(factorisations[0], 0u);
  EXPECT_EQ(factorisations[1], 1u);
  EXPECT_EQ(factorisations[2] + factorisations[3], 0u);
  // a renewed solver does as a new one
  solver.renew();
  ContactSolution again = state, fresh = state;
  solver.solve(block.at(0.31), again);
  NewtonSolver(parameters).solve(block.at(0.31), fresh);
  EXPECT_EQ(again.factorisations, fresh.factorisations);
  EXPECT_EQ(again.iterations, fresh.iterations);
  for (unsigned int row = 0; row < again.R.size(); ++row)
    EXPECT_EQ(again.R[row], fresh.R[row]) << row;
}

// The problems of one period after the other are the same. What the solver keeps has to give the forces of one that keeps nothing,
// and to serve once more.
TEST(Newton, MatricesServeAgainWhereAMotionComesBack)
{
  constexpr unsigned int period = 24;
  SlidingBlock block;
  ContactSolverParameters parameters;
  parameters.tolerance = 1e-9;
  NewtonSolver solver(parameters);
  ContactSolution state;
  unsigned int factorisations[6] = {};
  for (unsigned int k = 0; k < 6 * period; ++k)
  {
    const ContactProblem &problem = block.at(2 * M_PI * k / period);
    solver.solve(problem, state);
    ASSERT_TRUE(state.converged) << k;
    EXPECT_EQ(state.fallbacks, 0u) << k;
    factorisations[k / period] += state.factorisations;
    if (k % 5 != 0)
      continue;
    SCOPED_TRACE(k);
    expect_solution_of_a_new_solver(problem, parameters, state);
  }
  EXPECT_GT(factorisations[0], period / 2);
  EXPECT_LT(factorisations[5], 0.7 * factorisations[0]);
}

// A block that tilts while it slides: points open, close, stick and slide in every step, so that A is inverted and matrices are
// condensed. Forces have to be those of a solver that keeps nothing, with the approach given and with the force.
TEST(Newton, CondensedMatricesGiveTheForcesOfWholeOnes)
{
  for (const bool force_given : {false, true})
  {
    SlidingBlock block;
    ContactSolverParameters parameters;
    parameters.tolerance = 1e-9;
    NewtonSolver solver(parameters);
    ContactSolution state;
    for (unsigned int k = 0; k < 60; ++k)
    {
      ContactProblem problem = block.at(0.1 * k);
      for (unsigned int i = 0; i < 100; ++i)
        problem.b[i] = 6e-6 * (i % 10 / 10. - 0.5) * std::sin(0.3 * k) + 3e-6 * (i / 10 / 10. - 0.5);
      problem.normal_force = force_given ? 3000 : 0;
      solver.solve(problem, state);
      ASSERT_TRUE(state.converged) << k;
      EXPECT_EQ(state.fallbacks, 0u) << k;
      SCOPED_TRACE(k);
      expect_solution_of_a_new_solver(problem, parameters, state);
    }
  }
}
