// Contact of few points in place: against the common solver on random problems, its derivative against differences.
#include "matrix_difference.h"

#include <vibrocontact/contact/contact_solvers.h>
#include <vibrocontact/contact/few_points.h>
#include <vibrocontact/contact/laws/normal_laws.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace vibrocontact;

namespace
{
  /// A random positive definite, not symmetric matrix; b with some points in contact.
  struct RandomProblem
  {
    RandomProblem(const unsigned int n, const unsigned int seed) : A(3 * n, 3 * n), b(3 * n)
    {
      std::mt19937 random(seed);
      std::normal_distribution<double> number;
      DenseMatrix root(3 * n, 3 * n);
      for (unsigned int i = 0; i < 3 * n; ++i)
      {
        b[i] = (i < n ? 1e-4 : 3e-5) * (number(random) - (i < n ? 0.7 : 0.));
        for (unsigned int j = 0; j < 3 * n; ++j)
          root(i, j) = number(random);
      }
      for (unsigned int i = 0; i < 3 * n; ++i)
        for (unsigned int j = 0; j < 3 * n; ++j)
        {
          for (unsigned int k = 0; k < 3 * n; ++k)
            A(i, j) += 1e-8 * root(i, k) * root(j, k);
          A(i, j) += (i == j ? 1e-7 : 2e-9 * number(random));
        }
    }
    DenseMatrix A;
    std::vector<double> b;
  };
} // namespace

TEST(FewPoints, FindsWhatTheCommonSolverFinds)
{
  unsigned int touching = 0, compared = 0;
  for (const auto &law :
       {create_normal_law("signorini"), create_normal_law("exponential penalty", {30., 2e4})})
    for (unsigned int seed = 0; seed < 100; ++seed)
    {
      const unsigned int n = 1 + seed % 5;
      const RandomProblem given(n, seed);
      ContactProblem problem;
      problem.A = std::make_shared<DenseContactOperator>(given.A);
      problem.b = DenseVector(given.b.begin(), given.b.end());
      problem.mu.assign(n, 0.3);
      problem.normal_law = law;
      ContactSolverParameters parameters;
      parameters.tolerance = 1e-13;
      const ContactSolution common = create_contact_solver(parameters)->solve(problem, {});
      FewPoints few(given.A, 0.3, law);
      std::vector<double> R(3 * n, 0.);
      ASSERT_TRUE(few.solve(given.b.data(), R.data())) << seed;
      if (common.residual > 1e-12)
        continue;
      ++compared;
      touching += common.R[0] > 0;
      const std::vector<double> expected(common.R.begin(), common.R.end());
      EXPECT_LT(difference(expected, R), 1e-8) << seed << " " << law->description().name;
    }
  EXPECT_GT(compared, 190u);
  EXPECT_GT(touching, 50u);
}

TEST(FewPoints, DerivativeAgainstDifferences)
{
  for (unsigned int seed = 0; seed < 40; ++seed)
  {
    const unsigned int n = 1 + seed % 4, m = 3 * n;
    const RandomProblem given(n, seed);
    FewPoints few(given.A, 0.3, create_normal_law("signorini"));
    std::vector<double> R(m, 0.), rates(m * m);
    ASSERT_TRUE(few.solve(given.b.data(), R.data()));
    ASSERT_TRUE(few.sensitivity(rates.data()));
    for (unsigned int j = 0; j < m; ++j)
    {
      std::vector<double> plus = R, minus = R, b = given.b, slope(m);
      const double change = 1e-10;
      b[j] += change;
      ASSERT_TRUE(few.solve(b.data(), plus.data()));
      b[j] -= 2 * change;
      ASSERT_TRUE(few.solve(b.data(), minus.data()));
      double worst = 0, size = 0;
      for (unsigned int i = 0; i < m; ++i)
      {
        worst = std::max(worst, std::abs((plus[i] - minus[i]) / (2 * change) - rates[j * m + i]));
        size = std::max(size, std::abs(rates[j * m + i]));
      }
      EXPECT_LE(worst, 1e-4 * size + 1e-4) << seed << " " << j;
    }
  }
}
