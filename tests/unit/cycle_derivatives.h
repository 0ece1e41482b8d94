#pragma once

#include <vibrocontact/analyses/limit_cycle/limit_cycle.h>
#include <vibrocontact/numerics/eigenvalues.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

namespace vibrocontact
{
  /// The derivative of a period by its start, column by column.
  inline DenseMatrix derivative_by_start(const CycleMap &map)
  {
    DenseMatrix derivative(map.size(), map.size());
    for (unsigned int j = 0; j < map.size(); ++j)
    {
      DenseVector start(map.size());
      start[j] = 1;
      const DenseVector end = map.derivative(start);
      std::copy(end.begin(), end.end(), &derivative(0, j));
    }
    return derivative;
  }

  /// The monodromy matrix has the eigenvalues of a period's derivative by all of its start, but for zeros.
  inline void expect_same_multipliers(const CycleMap &map, const DenseMatrix &derivative)
  {
    const std::vector<std::complex<double>> found = general_eigenvalues(map.monodromy());
    double error = 0;
    for (const std::complex<double> &mu : general_eigenvalues(derivative))
    {
      double nearest = std::abs(mu);
      for (const std::complex<double> &other : found)
        nearest = std::min(nearest, std::abs(other - mu));
      error = std::max(error, nearest);
    }
    std::printf("multipliers by the monodromy matrix off by %.1e\n", error);
    EXPECT_LT(error, 1e-8);
  }

  /// The derivatives of a period against differences of marches through `other`.
  /// @param relative size of the differences over that of the state
  inline void expect_derivatives_of_differences(CycleMap &map, CycleMap &other, const LimitCycle &cycle,
                                                const double relative)
  {
    map.march(cycle.state, cycle.period, true);
    const DenseMatrix derivative = derivative_by_start(map);
    expect_same_multipliers(map, derivative);
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
