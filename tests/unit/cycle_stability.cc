// The trivial multiplier of a cycle told from the others, also where it meets another one.

#include <vibrocontact/analyses/limit_cycle/multipliers.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;

namespace
{
  /// Of three disturbances, the first along the motion.
  DenseMatrix monodromy(const double along, const double coupling, const double across, const double back = 0)
  {
    DenseMatrix M(3, 3);
    M(0, 0) = along;
    M(0, 1) = coupling;
    M(1, 0) = back;
    M(1, 1) = across;
    M(2, 2) = 0.3;
    return M;
  }

  DenseVector along_the_first()
  {
    DenseVector rate(3);
    rate[0] = 2;
    return rate;
  }
} // namespace

TEST(CycleStability, TheTrivialMultiplierIsNoneOfThoseListed)
{
  const CycleStability stability = cycle_stability(monodromy(1, 0.4, 0.9), along_the_first(), 0.01);
  ASSERT_EQ(stability.multipliers.size(), 2u);
  EXPECT_NEAR(stability.multipliers[0].value.real(), 0.9, 1e-12);
  EXPECT_NEAR(stability.multipliers[0].growth, std::log(0.9) / 0.01, 1e-9);
  EXPECT_NEAR(stability.trivial_error, 0, 1e-12);
  EXPECT_EQ(stability.verdict(), "stable");
}

TEST(CycleStability, AtAFoldTheOtherOneIsListed)
{
  // a Jordan block, and a pair that it became by errors of 1e-4
  for (const double back : {0., -1e-4})
  {
    const CycleStability stability = cycle_stability(monodromy(1, 0.4, 1, back), along_the_first(), 0.01);
    ASSERT_EQ(stability.multipliers.size(), 2u) << back;
    EXPECT_NEAR(std::abs(stability.multipliers[0].value), 1, 1e-3) << back;
    EXPECT_NEAR(stability.multipliers[1].value.real(), 0.3, 1e-12) << back;
    EXPECT_LT(stability.trivial_error, 1e-3) << back;
    EXPECT_EQ(stability.verdict(), "neutral") << back;
  }
}

TEST(CycleStability, WhatGrowsIsNamed)
{
  EXPECT_EQ(cycle_stability(monodromy(1, 0.4, 1.1), along_the_first(), 0.01).verdict(), "fold");
  EXPECT_EQ(cycle_stability(monodromy(1, 0.4, -1.1), along_the_first(), 0.01).verdict(), "period doubling");
}
