#include <vibrocontact/numerics/least_squares.h>

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

using namespace vibrocontact;

class TriangularFactor : public testing::TestWithParam<std::pair<unsigned int, unsigned int>>
{
};

// R^T R = A^T A, also of fewer rows than columns
TEST_P(TriangularFactor, HasTheProductsOfTheColumns)
{
  const auto [m, n] = GetParam();
  DenseMatrix A(m, n), of_A(n), of_R(n);
  for (unsigned int i = 0; i < m; ++i)
    for (unsigned int j = 0; j < n; ++j)
      A(i, j) = std::cos(1. + 3 * i + 7 * i * j + j);
  const DenseMatrix R = triangular_factor(A);
  A.Tmmult(of_A, A);
  R.Tmmult(of_R, R);
  for (unsigned int j = 0; j < n; ++j)
    for (unsigned int i = 0; i < n; ++i)
    {
      EXPECT_NEAR(of_R(i, j), of_A(i, j), 1e-13 * n);
      if (i > j)
      {
        EXPECT_EQ(R(i, j), 0.);
      }
    }
}

INSTANTIATE_TEST_SUITE_P(TallAndWide, TriangularFactor,
                         testing::Values(std::make_pair(7u, 4u), std::make_pair(4u, 4u),
                                         std::make_pair(3u, 6u)));
