#pragma once

#include <vibrocontact/analyses/limit_cycle/limit_cycle.h>
#include <vibrocontact/base/matrix_parts.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  /// Columns of a period's derivative by all steps of many at once against those by steps of each alone.
  inline void expect_same_columns(const CycleMap &map, const DenseMatrix &derivative)
  {
    double largest = 0, error = 0;
    for (unsigned int j = 0; j < map.size(); ++j)
    {
      DenseVector start(map.size());
      start[j] = 1;
      const DenseVector end = map.derivative(start);
      for (unsigned int i = 0; i < map.size(); ++i)
      {
        largest = std::max(largest, std::abs(end[i]));
        error = std::max(error, std::abs(end[i] - derivative(i, j)));
      }
    }
    std::printf("columns at once and alone differ by %.1e\n", error / largest);
    EXPECT_LT(error, 1e-11 * largest);
  }

  /// The monodromy matrix is what lasts of a period's derivative: the other rows are zero.
  inline void expect_lasting_part(const CycleMap &map, const DenseMatrix &derivative)
  {
    const std::vector<unsigned int> lasting = map.lasting_rows();
    const DenseMatrix monodromy = map.monodromy();
    ASSERT_EQ(monodromy.m(), lasting.size());
    ASSERT_EQ(monodromy.n(), lasting.size());
    for (unsigned int j = 0; j < lasting.size(); ++j)
      for (unsigned int i = 0; i < lasting.size(); ++i)
        EXPECT_NEAR(monodromy(i, j), derivative(lasting[i], lasting[j]), 1e-12);
    for (unsigned int i = 0; i < map.size(); ++i)
      if (!std::binary_search(lasting.begin(), lasting.end(), i))
        for (unsigned int j = 0; j < map.size(); ++j)
          EXPECT_EQ(derivative(i, j), 0);
  }

  /// The derivatives of a period against differences of marches through `other`.
  /// @param relative size of the differences over that of the state
  inline void expect_derivatives_of_differences(CycleMap &map, CycleMap &other, const LimitCycle &cycle,
                                                const double relative)
  {
    map.march(cycle.state, cycle.period, true);
    DenseMatrix units(map.size(), map.size());
    for (unsigned int i = 0; i < map.size(); ++i)
      units(i, i) = 1;
    const DenseMatrix derivative = map.derivative(units);
    expect_same_columns(map, derivative);
    expect_lasting_part(map, derivative);
    const DenseVector by_period = map.by_period();
    const double size = relative * cycle.state.l2_norm();
    double largest = 0, error = 0;
    for (unsigned int j = 0; j < map.size(); ++j)
    {
      DenseVector forwards = cycle.state, backwards = cycle.state;
      forwards[j] += size;
      backwards[j] -= size;
      DenseVector difference = other.march(forwards, cycle.period, false);
      difference -= other.march(backwards, cycle.period, false);
      for (unsigned int i = 0; i < map.size(); ++i)
      {
        largest = std::max(largest, std::abs(derivative(i, j)));
        error = std::max(error, std::abs(difference[i] / (2 * size) - derivative(i, j)));
      }
    }
    const double longer = 1e-7 * cycle.period;
    DenseVector difference = other.march(cycle.state, cycle.period + longer, false);
    difference -= other.march(cycle.state, cycle.period - longer, false);
    difference /= 2 * longer;
    difference -= by_period;
    const double of_period = difference.l2_norm() / by_period.l2_norm();
    std::printf("derivative by the start off by %.1e of its largest entry, by the period by %.1e\n",
                error / largest, of_period);
    EXPECT_LT(error, 1e-5 * largest);
    EXPECT_LT(of_period, 1e-5);
  }
} // namespace vibrocontact
