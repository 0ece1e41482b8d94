#pragma once

#include <vibrocontact/analyses/limit_cycle/period_equations.h>

#include <vector>

namespace vibrocontact
{
  /// The equations of a limit cycle: unknown are the state x and the period T. Their condition is p . dx = 0, p the direction in which
  /// the motion goes on, so that a step does not go along the cycle. BorderedCycle with T as the further unknown.
  class CycleEquations : public PeriodEquations
  {
  public:
    /// @param map is referred to @param equilibrium the state of rest that sizes are measured from
    /// @param linear linear_cycle() at the equilibrium, is referred to
    CycleEquations(CycleMap &map, const DenseVector &equilibrium, const DenseMatrix &linear,
                   double tolerance);

  private:
    /// @param x state, then the period [s]
    CycleMap &take(const std::vector<double> &x) override;
    DenseVector step() override;

    CycleMap &map;
    const DenseVector equilibrium;
    const DenseMatrix &linear;
  };
} // namespace vibrocontact
