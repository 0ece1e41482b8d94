#pragma once

#include <vibrocontact/analyses/limit_cycle/cycle_map.h>
#include <vibrocontact/numerics/newton_method.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// What Newton's method sees of a limit cycle: unknown are the state x that a period starts from and the period T,
  ///
  ///   x - Phi(x; T) = 0,      p . dx = 0
  ///
  /// Phi: CycleMap, p: the direction in which the motion goes on, so that a step does not go along the cycle. BorderedCycle with T as the
  /// further unknown.
  class CycleEquations : public NewtonEquations
  {
  public:
    /// @param map is referred to @param equilibrium the state of rest that sizes are measured from
    /// @param linear linear_cycle() at the equilibrium, is referred to
    CycleEquations(CycleMap &map, const DenseVector &equilibrium, const DenseMatrix &linear,
                   double tolerance);

    /// @param x state, then the period [s] @return |Phi - x| over |x - equilibrium|
    double evaluate(const std::vector<double> &x) override;
    bool keep(const std::vector<double> &x, double size) override;
    bool find_step(bool renew, std::vector<double> &step) override;

    /// why the last march or linear system failed; empty: it did not
    std::string failure;

  private:
    CycleMap &map;
    const DenseVector equilibrium;
    const DenseMatrix &linear;
    const unsigned int n;
    const double tolerance;
    DenseVector start, rest;
    double period = 0;
  };
} // namespace vibrocontact
