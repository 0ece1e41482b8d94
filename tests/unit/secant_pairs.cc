#include <vibrocontact/contact/secant_pairs.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;

namespace
{
  constexpr unsigned int n = 40;

  /// J x of J = 1 + sum of four rank-one matrices, of which the first alone makes x <- x + r diverge
  DenseVector product(const DenseVector &x)
  {
    DenseVector y(x);
    for (unsigned int k = 0; k < 4; ++k)
    {
      double share = 0;
      for (unsigned int j = 0; j < n; ++j)
        share += std::cos(0.3 * k + 0.7 * j * (k + 1)) * x[j];
      for (unsigned int i = 0; i < n; ++i)
        y[i] += (k == 0 ? 2. : 0.02) * share * std::sin(1. + i * (k + 2));
    }
    return y;
  }

  DenseVector right_side()
  {
    DenseVector b(n);
    for (unsigned int i = 0; i < n; ++i)
      b[i] = 1 + std::sin(2. * i);
    return b;
  }

  /// relative residual after some steps with the unit matrix in place of J^-1
  double residual_after(const unsigned int n_steps, const bool with_pairs)
  {
    const DenseVector b = right_side();
    DenseVector r(b);
    SecantPairs pairs;
    for (unsigned int k = 0; k < n_steps; ++k)
    {
      DenseVector rest(r), d(n);
      if (with_pairs)
        d = pairs.take_known_part(rest);
      d += rest;
      const DenseVector change = product(d);
      pairs.add(change, d);
      r -= change;
    }
    return r.l2_norm() / b.l2_norm();
  }
} // namespace

TEST(SecantPairs, FindWhatTheApproximateMatrixLacks)
{
  // four directions are unknown: after six steps nothing is left but rounding
  EXPECT_LT(residual_after(6, true), 1e-11);
  EXPECT_GT(residual_after(6, false), 1.);
}

TEST(SecantPairs, TheLatestIsRight)
{
  DenseVector e(2), step(2), residual(2);
  e[0] = 1;
  step[0] = 3;
  SecantPairs pairs;
  pairs.add(e, step);
  step[0] = 2;
  pairs.add(e, step); // contradicts the first
  residual[0] = 5;
  residual[1] = 7;
  const DenseVector known = pairs.take_known_part(residual);
  EXPECT_DOUBLE_EQ(known[0], 10.);
  EXPECT_DOUBLE_EQ(known[1], 0.);
  EXPECT_DOUBLE_EQ(residual[0], 0.);
  EXPECT_DOUBLE_EQ(residual[1], 7.);
}
