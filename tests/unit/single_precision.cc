// What steps in time take in single precision, beside the same in double precision.
#include <vibrocontact/contact/creep.h>
#include <vibrocontact/marching/step_operator.h>
#include <vibrocontact/numerics/single_factors.h>
#include <vibrocontact/numerics/wide_loops.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

using namespace vibrocontact;

namespace
{
  DenseMatrix random_matrix(const unsigned int n_rows, const unsigned int n_columns)
  {
    std::mt19937 random(3 * n_rows + n_columns);
    std::uniform_real_distribution<double> number(-1, 1);
    DenseMatrix result(n_rows, n_columns);
    for (unsigned int j = 0; j < n_columns; ++j)
      for (unsigned int i = 0; i < n_rows; ++i)
        result(i, j) = number(random);
    return result;
  }

  /// A random flexibility and two modes on a grid.
  ContactPair pair_with_modes(const unsigned int n_x, const unsigned int n_y)
  {
    const unsigned int n = n_x * n_y;
    ContactPair pair;
    ContactGrid &grid = pair.interface.contacts.only();
    grid.n_x = n_x;
    grid.n_y = n_y;
    grid.spacing_x = grid.spacing_y = 1e-3;
    pair.interface.gap.assign(n, 0.);
    pair.residual = random_matrix(3 * n, 3 * n);
    pair.residual *= 1e-9;
    pair.omega = {3e3, 7e3};
    pair.damping_ratio = {1e-3, 1e-3};
    pair.modal_load = {0., 0.};
    pair.trace = random_matrix(3 * n, 2);
    pair.labels = {"body:1", "body:2"};
    pair.body = {1, 1};
    return pair;
  }

  /// of steps of 10 us at 10 m/s
  StepMatrices matrices_of(const ContactPair &pair)
  {
    const double h = 1e-5, speed = 10;
    std::vector<ModalStep> steps;
    for (unsigned int k = 0; k < pair.n_modes(); ++k)
      steps.push_back(
          exact_step(pair.omega[k], pair.damping_ratio[k], h, ReactionWeighting::as_other_forces));
    return step_matrices(creep_schemes().front(), pair, steps, h, speed);
  }
} // namespace

TEST(SingleFactors, OfAnySizeSolveWhatWasFactorised)
{
  SingleFactors factors;
  // widths of one block, one and a part, several, one after the other in the same object; rows have to change places, for the
  // diagonal is zero
  for (const unsigned int n : {312u, 1u, 2u, 47u, 48u, 49u, 96u, 145u})
  {
    DenseMatrix matrix = random_matrix(n, n);
    for (unsigned int i = 0; i < n; ++i)
    {
      matrix(i, i) = 0;
      matrix(i, (i + 1) % n) += 3 * std::sqrt(n);
    }
    DenseVector exact(n), x(n);
    for (unsigned int i = 0; i < n; ++i)
      exact[i] = std::cos(1. + i);
    matrix.vmult(x, exact);
    ASSERT_TRUE(factors.factorise(matrix)) << n;
    factors.solve(x);
    for (unsigned int i = 0; i < n; ++i)
      EXPECT_NEAR(x[i], exact[i], 2e-5) << n << ", " << i;
    DenseMatrix singular(n);
    EXPECT_FALSE(factors.factorise(singular)) << n;
    EXPECT_TRUE(factors.empty());
  }
}

TEST(SingleFactors, OfAFlexibilityLeaveLittleOfTheRightHandSide)
{
  // forces that close gaps of a smooth flexibility: the worse conditioned, the further a force reaches
  const unsigned int n = 150;
  for (const double reach : {1., 5., 20.})
  {
    DenseMatrix matrix(n);
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        matrix(i, j) = std::exp(-std::abs(double(i) - double(j)) / reach);
    DenseVector right(n), x(n), defect(n);
    for (unsigned int i = 0; i < n; ++i)
      x[i] = right[i] = std::cos(0.05 * i);
    SingleFactors factors;
    ASSERT_TRUE(factors.factorise(matrix));
    factors.solve(x);
    matrix.vmult(defect, x);
    defect -= right;
    EXPECT_LT(defect.l2_norm(), 1e-5 * right.l2_norm()) << reach;
  }
}

TEST(WideLoops, ColumnsInSinglePrecisionOfAnyPaddedLength)
{
  for (unsigned int n = 16; n <= 528; n += 16)
  {
    const unsigned int n_columns = 9;
    const DenseMatrix matrix = random_matrix(n, n_columns);
    const std::vector<unsigned int> listed = {7, 0, 4};
    const std::vector<float> factors = {0.5F, -2, 3};
    std::vector<float> columns(n * n_columns), some(n, 1), all(n, 1), weights(n_columns, 0.25F);
    for (unsigned int j = 0; j < n_columns; ++j)
      for (unsigned int i = 0; i < n; ++i)
        columns[n * j + i] = static_cast<float>(matrix(i, j));
    wide_add_columns(some.data(), columns.data(), n, listed.data(), factors.data(), listed.size());
    wide_add_columns(all.data(), columns.data(), n, nullptr, weights.data(), n_columns);
    for (unsigned int i = 0; i < n; ++i)
    {
      double sum = 1;
      for (unsigned int j = 0; j < n_columns; ++j)
        sum += 0.25 * matrix(i, j);
      EXPECT_NEAR(all[i], sum, 2e-6) << n << ", " << i;
      EXPECT_NEAR(some[i], 1 + 0.5 * matrix(i, 7) - 2 * matrix(i, 0) + 3 * matrix(i, 4), 2e-6)
          << n << ", " << i;
    }
  }
}

TEST(StepOperator, ChangesInSinglePrecisionAreThoseOfTheWholeProduct)
{
  const unsigned int n_x = 12, n = 60;
  const ContactPair pair = pair_with_modes(n_x, n / n_x);
  const StepMatrices matrices = matrices_of(pair);
  // the grid without its last columns
  std::vector<unsigned int> nearby;
  for (unsigned int i = 0; i < n; ++i)
    if (i % n_x < 9)
      nearby.push_back(i);
  const StepOperator A(matrices, nearby);
  const unsigned int m = nearby.size();
  std::vector<unsigned int> all(m);
  std::iota(all.begin(), all.end(), 0u);
  for (const std::vector<unsigned int> &sources :
       {all, std::vector<unsigned int>{3, 17, 18}, std::vector<unsigned int>{44}, {}})
  {
    DenseVector change(3 * m), y, single;
    for (const unsigned int i : sources)
      for (unsigned int c = 0; c < 3; ++c)
        change[c * m + i] = std::sin(1. + i + 10 * c);
    A.vmult(y, change, sources);
    A.vmult_change(single, change, sources);
    ASSERT_EQ(single.size(), A.n_response_rows());
    // gaps, slips and residual displacements, each beside the largest of its kind
    const std::vector<unsigned int> begins = {0, m, 3 * m, A.n_response_rows()};
    for (unsigned int kind = 0; kind < 3; ++kind)
    {
      double largest = 0, off = 0;
      for (unsigned int row = begins[kind]; row < begins[kind + 1]; ++row)
      {
        largest = std::max(largest, std::abs(y[row]));
        off = std::max(off, std::abs(single[row] - y[row]));
      }
      EXPECT_EQ(largest > 0, !sources.empty());
      EXPECT_LE(off, 1e-6 * largest) << sources.size() << " points, " << kind;
      // double precision would be right to its rounding
      EXPECT_EQ(off > 1e-12 * largest, !sources.empty()) << sources.size() << " points, " << kind;
    }
  }
}

TEST(StepOperator, ChangesOfFewPointsAreInDoublePrecision)
{
  const ContactPair pair = pair_with_modes(12, 1);
  const StepMatrices matrices = matrices_of(pair);
  const StepOperator A(matrices, {2, 3, 4, 5, 6});
  DenseVector change(15), y, same;
  for (unsigned int i = 0; i < 15; ++i)
    change[i] = std::sin(1. + i);
  A.vmult(y, change, {0, 1, 2, 3, 4});
  A.vmult_change(same, change, {0, 1, 2, 3, 4});
  for (unsigned int row = 0; row < A.n_response_rows(); ++row)
    EXPECT_EQ(same[row], y[row]) << row;
}
