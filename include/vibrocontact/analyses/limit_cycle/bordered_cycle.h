#pragma once

#include <vibrocontact/analyses/limit_cycle/cycle_map.h>

#include <memory>
#include <vector>

namespace vibrocontact
{
  /// The linear system of a Newton iteration for a motion that repeats itself: beside the state further unknowns u, with a condition each,
  ///
  ///   [ I - Phi_x   -C ] [dx]   [ Phi - x ]
  ///   [ R^T          D ] [du] = [    r    ]
  ///
  /// Phi: CycleMap. GMRES solves it, a product being a period of linear steps.
  struct BorderedCycle
  {
    /// with the derivatives of its last march
    const CycleMap &map;
    /// of C and of R
    std::vector<DenseVector> columns, rows;
    /// D
    DenseMatrix corner;

    /// In units of u that make the columns one, which columns and corner are left in.
    /// @param linear linear_cycle(), for the preconditioner @return dx, then du; the best that was found, the line search judges it
    /// @throws ConvergenceError if a column or the preconditioner is singular or nothing finite was found
    DenseVector solve(const DenseMatrix &linear, const DenseVector &right);
    /// for GMRES
    void vmult(DenseVector &to, const DenseVector &from) const;
  };

  /// The factors of I - A^n, A: the derivative of one step at the equilibrium (CycleMap::one_step()), n: the steps of a period. So Phi_x would be if
  /// all points that slide went on to slide. Contact that sticks for a part of the period changes it in few directions.
  /// Where they are, since a copy would have no pivots. @throws ConvergenceError if it is singular
  std::unique_ptr<const DenseMatrix> linear_cycle(const DenseMatrix &step, unsigned int n_steps);
} // namespace vibrocontact
