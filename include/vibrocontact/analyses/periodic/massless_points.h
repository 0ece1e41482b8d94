#pragma once

#include <vibrocontact/contact/few_points.h>

#include <vector>

namespace vibrocontact
{
  /// Contact points without mass on the residual flexibility S of a body, before rigid stops with Coulomb friction, at one
  /// instant: the forces p on the body that make u = w + S p obey
  ///
  ///   u_n <= gap, p_n <= 0, (u_n - gap) p_n = 0,     p_t = Proj_disc(mu |p_n|) (p_t - r (u_t - u_t before))
  ///
  /// at w, the motion that the modes prescribe. Rows: normal, with friction two tangential ones behind it, of each point.
  class MasslessPoints
  {
  public:
    /// @param residual S, positive on the diagonal @param rows_per_point 1 or 3 @param friction of each point [-]
    MasslessPoints(const DenseMatrix &residual, unsigned int rows_per_point,
                   const std::vector<double> &friction);

    unsigned int n_rows() const { return n; }
    /// @param before u at the instant before; tangential rows count @param p the forces there, then those here
    /// @return false if no solution was found
    bool solve(const std::vector<double> &w, const double *before, const std::vector<double> &gap,
               std::vector<double> &p);
    /// Of the last solution.
    const std::vector<ContactStatus> &status() const { return solution.status; }
    /// dp/dw at the last solution, n_rows square, row by row. dp/d(before) is its negative in tangential columns, zero in
    /// normal ones. @return false if there is none
    bool rates(double *by_w);
    bool is_normal(const unsigned int row) const { return row % per_point == 0; }

    /// n_rows square
    const DenseMatrix S;

  private:
    /// place of a row in the contact problem, and its sign there: p_n = -N
    unsigned int at(const unsigned int row) const
    {
      return row % per_point * (n / per_point) + row / per_point;
    }
    double sign(const unsigned int row) const { return is_normal(row) ? -1. : 1.; }

    const unsigned int n, per_point;
    ContactProblem problem;
    ContactSolution solution;
    FewPointsSolver contact;
    std::vector<double> by_b;
  };
} // namespace vibrocontact
