#include <vibrocontact/base/dense_operations.h>

#include <gtest/gtest.h>

using namespace vibrocontact;

namespace
{
  DenseMatrix waves(const unsigned int m, const unsigned int n)
  {
    DenseMatrix result(m, n);
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < m; ++i)
        result(i, j) = std::sin(1. + 3 * i + 7 * j);
    return result;
  }
} // namespace

TEST(DenseOperations, ProductsOfOneMatrixWithSeveralVectors)
{
  const DenseMatrix A = waves(5, 9);
  // columns without any factor at the beginning, in the middle and at the end; one vector has zeros where the other has none
  DenseVector x(9), z(9), y(7), w(5);
  for (const unsigned int column : {1, 2, 6})
    x[column] = 1.5 + column;
  z[2] = -4;
  z[4] = 0.25;
  for (unsigned int i = 0; i < 7; ++i)
    y[i] = 10 + i;
  add_products(A, {&x, &z}, {&y, &w});
  DenseVector alone(5);
  add_products(A, {&x}, {&alone});
  for (unsigned int i = 0; i < 5; ++i)
  {
    double of_x = 0, of_z = 0;
    for (unsigned int j = 0; j < 9; ++j)
    {
      of_x += A(i, j) * x[j];
      of_z += A(i, j) * z[j];
    }
    EXPECT_NEAR(y[i], 10 + i + of_x, 1e-13);
    EXPECT_NEAR(w[i], of_z, 1e-14);
    EXPECT_NEAR(alone[i], of_x, 1e-13);
  }
  EXPECT_EQ(y[5], 15);
  EXPECT_EQ(y[6], 16);
}

TEST(DenseOperations, ProductsOfAnEmptyMatrix)
{
  DenseVector y(2), x(3), nothing;
  y[0] = 1;
  add_products(DenseMatrix(), {&nothing}, {&y});
  add_products(DenseMatrix(0, 3), {&x}, {&y});
  add_products(DenseMatrix(2, 0), {&nothing}, {&y});
  EXPECT_EQ(y[0], 1);
  EXPECT_EQ(y[1], 0);
}
