#pragma once

#include <vibrocontact/base/dense.h>
#include <vibrocontact/numerics/lu_factors.h>

#include <vector>

namespace vibrocontact
{
  /// The matrix [a J, b p; row] of Newton's method on a curve J dx + p dp = 0, factorised by LAPACK.
  class BorderedMatrix
  {
  public:
    /// @param J n square @param p n values @param row n + 1 values @param a, b factors of J and of p
    /// @return false if it is singular or has values that are not finite
    bool factorise(const DenseMatrix &J, double a, const std::vector<double> &p, double b,
                   const std::vector<double> &row);
    /// Sign of the determinant.
    int sign() const { return factors.sign(); }
    /// @param rhs n + 1 values, then the solution
    void solve(std::vector<double> &rhs) const { factors.solve(rhs); }

  private:
    LuFactors<double> factors;
  };
} // namespace vibrocontact
