#pragma once

#include <vibrocontact/base/dense.h>
#include <vibrocontact/contact/contact_problem.h>

#include <memory>
#include <vector>

namespace vibrocontact
{
  /// The contact problem of few points with a stored matrix (contact/contact_problem.h), for steps that are made by the
  /// million: semi-smooth Newton on the projections, in place and without allocation, with the derivative of the solution.
  ///
  ///   y = A R + b,   N_i = P(N_i, gap_i; rho_i),   T_i = Proj_disc(mu N_i)(T_i - rho_i' s_i)
  ///
  /// each point with rho of its own, 1 / A_nn and 1 / max(A_xx, A_yy). Where Newton's steps do not lower the residual the
  /// points are projected one after the other. Rows by contact_row().
  class FewPoints
  {
  public:
    /// @param matrix A, 3 n square; @param mu of all points; @param law normal law
    FewPoints(DenseMatrix matrix, double mu, std::shared_ptr<const NormalLaw> law);

    /// @param b 3 n; @param R start on entry, solution on return; 3 n [N]
    /// @return whether it was found: the largest defect of a projection is below 1e-11 of the largest
    /// force, or of that which would close the widest gap
    bool solve(const double *b, double *R);
    /// of the last solution
    ContactStatus status(const unsigned int point) const { return statuses[point]; }
    /// dR/db at the last solution, 3 n square, by columns. @return false if it has none
    bool sensitivity(double *rates);

  private:
    double linearise(const double *b, const double *R);

    const unsigned int n;
    const DenseMatrix A;
    const double mu;
    const std::shared_ptr<const NormalLaw> law;
    /// defects of the projections and their derivatives with respect to R and b, by columns
    std::vector<double> defect, by_R, by_b;
    std::vector<double> y, trial, step, factors;
    std::vector<dealii::types::blas_int> pivots;
    std::vector<ContactStatus> statuses;
  };
} // namespace vibrocontact
