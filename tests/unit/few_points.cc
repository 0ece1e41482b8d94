// Contact of few points in place: against Newton on random problems, its derivative against differences.
#include "matrix_difference.h"
#include "random_contact.h"

#include <vibrocontact/contact/few_points.h>
#include <vibrocontact/contact/newton.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;

TEST(FewPoints, FindsWhatTheCommonSolverFinds)
{
  unsigned int touching = 0, compared = 0;
  for (const auto &law :
       {create_normal_law("signorini"), create_normal_law("exponential penalty", {30., 2e4})})
    for (unsigned int seed = 0; seed < 100; ++seed)
    {
      const unsigned int n = 1 + seed % 5;
      const ContactProblem problem = random_contact(n, 3, 0.3, law, seed);
      ContactSolverParameters parameters;
      parameters.tolerance = 1e-13;
      const ContactSolution common = NewtonSolver(parameters).solved(problem),
                            few = FewPointsSolver(parameters).solved(problem);
      ASSERT_TRUE(few.converged) << seed;
      if (common.residual > 1e-12)
        continue;
      ++compared;
      touching += common.R[0] > 0;
      EXPECT_LT(difference(std::vector<double>(common.R.begin(), common.R.end()),
                           std::vector<double>(few.R.begin(), few.R.end())),
                1e-8)
          << seed << " " << law->description().name;
    }
  EXPECT_GT(compared, 190u);
  EXPECT_GT(touching, 50u);
}

TEST(FewPoints, DerivativeAgainstDifferences)
{
  for (unsigned int seed = 0; seed < 40; ++seed)
  {
    const unsigned int n = 1 + seed % 4, m = 3 * n;
    ContactProblem problem = random_contact(n, 3, 0.3, create_normal_law("signorini"), seed);
    FewPointsSolver few;
    ContactSolution solution;
    std::vector<double> rates(m * m);
    few.solve(problem, solution);
    ASSERT_TRUE(solution.converged);
    ASSERT_TRUE(few.sensitivity(rates.data()));
    for (unsigned int j = 0; j < m; ++j)
    {
      ContactSolution plus = solution, minus = solution;
      const double change = 1e-10;
      problem.b[j] += change;
      few.solve(problem, plus);
      problem.b[j] -= 2 * change;
      few.solve(problem, minus);
      problem.b[j] += change;
      ASSERT_TRUE(plus.converged && minus.converged);
      double worst = 0, size = 0;
      for (unsigned int i = 0; i < m; ++i)
      {
        worst = std::max(worst, std::abs((plus.R[i] - minus.R[i]) / (2 * change) - rates[j * m + i]));
        size = std::max(size, std::abs(rates[j * m + i]));
      }
      EXPECT_LE(worst, 1e-4 * size + 1e-4) << seed << " " << j;
    }
  }
}
