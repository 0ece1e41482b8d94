#pragma once

#include <vibrocontact/contact/contact_solver.h>

#include <deal.II/lac/lapack_support.h>

#include <vector>

namespace vibrocontact
{
  /// The contact problem of few points, any laws, the approach given, for steps that are made by the million: semi-smooth
  /// Newton on the projections over all points, in place and without allocation, with the derivative of the solution.
  ///
  ///   y = A R + b - approach a,   N_i = P(N_i, gap_i; rho_i),   T_i = Proj_disc(mu_i N_i)(T_i - rho_i' s_i)
  ///
  /// each point with rho of its own, 1 / A_nn and 1 / max(A_xx, A_yy). Where Newton's steps do not lower the defect the
  /// points are projected one after the other, in turn wholly and by shorter steps.
  ///
  /// Steps go on while the largest defect of a projection falls, to 1e-11 of the largest force or of that which would
  /// close the widest gap; what they leave is projected once. It has converged where ContactResidual, which judges all
  /// solvers, is below the tolerance.
  class FewPointsSolver : public ContactSolver
  {
  public:
    explicit FewPointsSolver(const ContactSolverParameters &parameters = {}) : tolerance(parameters.tolerance)
    {
    }
    static bool takes(const ContactProblem &problem);

    void solve(const ContactProblem &problem, ContactSolution &state) override;
    void prepare(const ContactProblem &problem) override;
    /// dR/db at the last solution, as many rows as the problem, square, by columns. @return false if it has none
    bool sensitivity(double *rates);

  private:
    double linearise(const ContactProblem &problem, const ContactResidual &judge, const double *R);
    bool take_step(const ContactProblem &problem, const ContactResidual &judge, double *R, double &error);
    double project(const ContactProblem &problem, const ContactResidual &judge, double *R,
                   double relaxation = 1);
    bool find(const ContactProblem &problem, const ContactResidual &judge, ContactSolution &state,
              double &error);

    const double tolerance;
    /// whose matrix is kept
    std::shared_ptr<const ContactOperator> operator_of_matrix;
    DenseMatrix A;
    unsigned int n = 0, n_components = 0, n_rows = 0;
    /// b - approach a; defects of the projections and their derivatives with respect to R and b, by columns
    DenseVector b;
    std::vector<double> defect, by_R, by_b;
    std::vector<double> y, trial, step, factors;
    std::vector<dealii::types::blas_int> pivots;
    DenseVector projected;
  };
} // namespace vibrocontact
