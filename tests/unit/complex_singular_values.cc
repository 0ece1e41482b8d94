// Singular values of complex matrices of any shape.
#include <vibrocontact/base/complex_dense.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/numerics/complex_singular_values.h>

#include <gtest/gtest.h>

#include <limits>
#include <random>

using namespace vibrocontact;
using Complex = std::complex<double>;

TEST(ComplexSingularValues, TheirSumIsTheMatrix)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> entry(-1, 1);
  for (const auto &[m, n] : {std::pair{40, 12}, {12, 40}, {64, 1}, {1, 3}, {7, 7}, {25, 25}})
  {
    ComplexMatrix A(m, n);
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < m; ++i)
        A(i, j) = {entry(random), entry(random)};
    const ComplexSingularValues found = complex_singular_values(A);
    const int k = std::min(m, n);
    ASSERT_EQ(found.values.size(), std::size_t(k));
    double worst = 0;
    for (int i = 0; i < m; ++i)
      for (int j = 0; j < n; ++j)
      {
        Complex sum = 0;
        for (int r = 0; r < k; ++r)
          sum += found.left(i, r) * found.values[r] * found.right(r, j);
        worst = std::max(worst, std::abs(sum - A(i, j)));
      }
    for (int r = 0; r < k; ++r)
    {
      EXPECT_LE(found.values[r], found.values[0]);
      for (int s = 0; s < k; ++s)
      {
        Complex of_left = 0, of_right = 0;
        for (int i = 0; i < m; ++i)
          of_left += std::conj(found.left(i, r)) * found.left(i, s);
        for (int j = 0; j < n; ++j)
          of_right += found.right(r, j) * std::conj(found.right(s, j));
        worst = std::max({worst, std::abs(of_left - double(r == s)), std::abs(of_right - double(r == s))});
      }
    }
    EXPECT_LT(worst, 1e-13) << m << " x " << n;
  }
}

TEST(ComplexSingularValues, EntriesThatAreNoNumbersAreRefused)
{
  ComplexMatrix A(3, 2);
  A(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(complex_singular_values(A), ConvergenceError);
}
