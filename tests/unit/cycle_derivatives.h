#pragma once

#include <vibrocontact/analyses/limit_cycle/limit_cycle.h>

#include <gtest/gtest.h>

#include <cmath>

namespace vibrocontact
{
  /// The derivatives of a period against differences of marches through `other`.
  /// @param relative size of the differences over that of the state
  inline void expect_derivatives_of_differences(CycleMap &map, CycleMap &other, const LimitCycle &cycle,
                                                const double relative)
  {
    map.march(cycle.state, cycle.period, true);
    const DenseMatrix monodromy = map.monodromy();
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
        largest = std::max(largest, std::abs(monodromy(i, j)));
        error = std::max(error, std::abs(difference[i] / (2 * size) - monodromy(i, j)));
      }
    }
    const double longer = 1e-7 * cycle.period;
    DenseVector difference = other.march(cycle.state, cycle.period + longer, false);
    difference -= other.march(cycle.state, cycle.period - longer, false);
    difference /= 2 * longer;
    difference -= by_period;
    const double of_period = difference.l2_norm() / by_period.l2_norm();
    std::printf("monodromy off by %.1e of its largest entry, derivative by the period by %.1e\n",
                error / largest, of_period);
    EXPECT_LT(error, 1e-5 * largest);
    EXPECT_LT(of_period, 1e-5);
  }
} // namespace vibrocontact
