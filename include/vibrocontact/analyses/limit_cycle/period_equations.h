#pragma once

#include <vibrocontact/analyses/limit_cycle/cycle_map.h>
#include <vibrocontact/numerics/newton_method.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// What Newton's method sees of a motion that repeats itself: the state x that a period starts from, the period T and what else
  /// is unknown fulfil
  ///
  ///   Phi(x; T) - x = 0
  ///
  /// and a condition for each further unknown. Phi: CycleMap. What a march or a linear system throws ends the method.
  class PeriodEquations : public NewtonEquations
  {
  public:
    /// @return |Phi - x| over |x - equilibrium|
    double evaluate(const std::vector<double> &unknowns) override;
    bool keep(const std::vector<double> &unknowns, double size) override;
    bool find_step(bool renew, std::vector<double> &step) override;

    /// why the last march or linear system failed; empty: it did not
    std::string failure;

  protected:
    explicit PeriodEquations(double tolerance);

    /// Sets start, from_rest and period. @return the map there @throws ConvergenceError
    virtual CycleMap &take(const std::vector<double> &unknowns) = 0;
    /// Of all unknowns, by a BorderedCycle. @throws ConvergenceError
    virtual DenseVector step() = 0;
    /// Phi - x, and zero for so many conditions.
    DenseVector right_side(unsigned int n_conditions) const;

    /// x, x less the equilibrium, Phi - x
    DenseVector start, from_rest, rest;
    /// T [s]
    double period = 0;

  private:
    const double tolerance;
  };
} // namespace vibrocontact
