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
  /// Phi: CycleMap, p: the direction in which the motion goes on, so that a step does not go along the cycle. The linear system
  ///
  ///   [ I - Phi_x   -Phi_T ] [dx]   [ Phi - x ]
  ///   [ p^T            0   ] [dT] = [    0    ]
  ///
  /// is solved by GMRES. Its preconditioner is the same system with the derivative of one step at the equilibrium, to the power of the steps
  /// of a period, in place of Phi_x: all points that slide go on to slide. Contact that sticks for a part of the period changes
  /// it in few directions.
  class CycleEquations : public NewtonEquations
  {
  public:
    /// @param map is referred to @param equilibrium the state of rest that sizes are measured from
    /// @param step_at_equilibrium CycleMap::one_step()
    CycleEquations(CycleMap &map, const DenseVector &equilibrium, const DenseMatrix &step_at_equilibrium,
                   double tolerance);

    /// @param x state, then the period [s] @return |Phi - x| over |x - equilibrium|
    double evaluate(const std::vector<double> &x) override;
    bool keep(const std::vector<double> &x, double size) override;
    bool find_step(bool renew, std::vector<double> &step) override;
    /// The bordered derivative, dT in the unit that makes its column one; for GMRES.
    void vmult(DenseVector &to, const DenseVector &from) const;

    /// why the last march or linear system failed; empty: it did not
    std::string failure;

  private:
    CycleMap &map;
    const DenseVector equilibrium;
    const unsigned int n;
    const double tolerance;
    /// I less the linear dynamics over a period
    DenseMatrix linear;
    DenseVector start, rest, by_period, phase;
    double period = 0, unit_of_period = 1;
  };
} // namespace vibrocontact
