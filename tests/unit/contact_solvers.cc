// The table of contact solvers: random problems of every kind by every row that takes them, and what rows refuse.
#include "random_contact.h"

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/contact/contact_solvers.h>
#include <vibrocontact/contact/even_line_operator.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>

using namespace vibrocontact;

namespace
{
  ContactSolution solved(const std::string &method, const ContactProblem &problem)
  {
    ContactSolverParameters parameters;
    parameters.method = method;
    parameters.tolerance = 1e-12;
    parameters.force_change = 1e-15;
    return create_contact_solver(parameters)->solved(problem);
  }

  /// The same with a matrix of points evenly apart on a tread.
  ContactProblem on_even_line(ContactProblem problem, const unsigned int seed)
  {
    const unsigned int n = problem.n_points();
    DenseMatrix matrix(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        matrix(i, j) = problem.A->mean_diagonal(0) * ((i == j) + 0.01 * std::cos(double(seed) + i - j));
    problem.A = EvenLineOperator::of(matrix);
    return problem;
  }
} // namespace

TEST(ContactSolvers, AllThatTakeAProblemFindTheSameForces)
{
  std::map<std::string, unsigned int> taken;
  unsigned int touching = 0;
  for (unsigned int seed = 0; seed < 300; ++seed)
  {
    const unsigned int n = 1 + seed % 7, n_components = 1 + seed / 7 % 3;
    const bool yields = seed % 4 == 0, force_given = seed % 5 == 0;
    ContactProblem problem = random_contact(
        n, n_components, seed % 3 == 0 ? 0. : 0.25,
        yields ? create_normal_law("exponential penalty", {30., 2e4}) : create_normal_law("signorini"), seed);
    problem.normal_force = force_given ? 50. : 0.;
    problem.approach = seed % 2 * 2e-5;
    if (n_components == 1 && seed % 4 < 2)
      problem = on_even_line(std::move(problem), seed);
    const ContactSolution reference = solved("semi-smooth newton", problem);
    ASSERT_TRUE(reference.converged) << seed << " " << reference.residual;
    for (const ContactSolverEntry &entry : contact_solvers())
    {
      if (entry.takes && !entry.takes(problem))
      {
        EXPECT_THROW(solved(entry.name, problem), InputError) << entry.name;
        continue;
      }
      ++taken[entry.name];
      const ContactSolution s = solved(entry.name, problem);
      EXPECT_TRUE(s.converged) << seed << " " << entry.name;
      EXPECT_EQ(s.R.size(), n * n_components);
      DenseVector difference = s.R;
      difference -= reference.R;
      EXPECT_LE(difference.l2_norm(), 1e-10 * reference.R.l2_norm()) << seed << " " << entry.name;
      EXPECT_NEAR(s.approach, reference.approach, 1e-10 * std::abs(reference.approach)) << entry.name;
      // one residual judges all: what is told of a state is what ContactResidual finds in it
      DenseVector y, projected;
      std::vector<ContactStatus> status;
      contact_response(problem, s.R, s.approach, y);
      if (s.R.l2_norm() > 0)
        EXPECT_LE(ContactResidual(problem).evaluate(s.R, y, projected, status), 1e-11) << entry.name;
      EXPECT_EQ(status.empty() ? s.status : status, s.status) << seed << " " << entry.name;
      touching += s.status[0] != ContactStatus::open;
    }
  }
  EXPECT_GT(touching, 200u);
  EXPECT_EQ(taken.size(), contact_solvers().size());
  for (const auto &[name, times] : taken)
    EXPECT_GT(times, 15u) << name;
}

// What a row keeps belongs to an operator: problems in turn are as good as each by itself.
TEST(ContactSolvers, AnotherOperatorIsSeen)
{
  for (const ContactSolverEntry &entry : contact_solvers())
  {
    ContactSolverParameters parameters;
    parameters.method = entry.name;
    parameters.tolerance = 1e-12;
    parameters.force_change = 1e-15;
    const auto solver = create_contact_solver(parameters);
    for (unsigned int k = 0; k < 12; ++k)
    {
      ContactProblem problem = random_contact(1 + k / 2 % 4, 1, 0., create_normal_law("signorini"), k / 2);
      if (entry.takes && !entry.takes(problem))
        problem = on_even_line(std::move(problem), k);
      solver->prepare(problem);
      const ContactSolution s = solver->solved(problem), alone = solved(entry.name, problem);
      DenseVector difference = s.R;
      difference -= alone.R;
      EXPECT_LE(difference.l2_norm(), 1e-10 * alone.R.l2_norm()) << entry.name;
      solver->renew();
    }
  }
}

TEST(ContactSolvers, ARefusalNamesTheMethodAndWhatItTakes)
{
  for (const ContactSolverEntry &entry : contact_solvers())
  {
    if (!entry.takes)
      continue;
    ContactProblem problem = random_contact(6, 3, 0.3, create_normal_law("signorini"), 1);
    try
    {
      solved(entry.name, problem);
      ADD_FAILURE() << entry.name;
    }
    catch (const InputError &error)
    {
      const std::string text = error.what();
      EXPECT_NE(text.find("Method is " + entry.name + ", which takes " + entry.asks_for), std::string::npos)
          << text;
    }
  }
}
