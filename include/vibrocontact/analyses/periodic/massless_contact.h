#pragma once

#include <vibrocontact/contact/few_points.h>

#include <vector>

namespace vibrocontact
{
  /// Contact points without mass on the residual flexibility S of a body, before rigid stops with Coulomb friction, sample
  /// after sample: the forces p on the body that make u = w + S p obey
  ///
  ///   u_n <= gap, p_n <= 0, (u_n - gap) p_n = 0,     p_t = Proj_disc(mu |p_n|) (p_t - r (u_t - u_t before))
  ///
  /// at w, the motion that the modes prescribe. Forces follow from the motion alone - a history of it, since the points
  /// stick and slip -, with the rates that Newton's method asks for; they need no functions of time of their own.
  class MasslessContact
  {
  public:
    /// @param residual S, positive on the diagonal; rows: normal, two tangential of each point
    /// @param friction coefficient of each point [-]
    MasslessContact(const DenseMatrix &residual, const std::vector<double> &friction);

    /// Marches through the samples of w (row after row), from one where no point touches; twice if there is none. Fills
    /// the samples of the forces on the body, p (same layout).
    /// @return false if a sample found no solution
    bool march(const std::vector<double> &w, const std::vector<double> &gap, std::vector<double> &p);

    /// Of the last march, at the samples of each point.
    const std::vector<ContactStatus> &status() const { return statuses; }

    /// Moments of the rates of p: for every sample k, weight(k, i) (dp_r / dw_(s, j) basis(., j)) summed into
    /// (r n_weights + i, s n_functions + j) of `into`. After march(). @param growth of the basis, less of the weights, over
    /// an interval between samples: rates of motions that are periodic but for a factor e^(growth k)
    void add_rates(const DenseMatrix &basis, const DenseMatrix &weights, DenseMatrix &into,
                   double growth = 0) const;

  private:
    const DenseMatrix S;
    ContactProblem problem;
    ContactSolution solution;
    FewPointsSolver contact;
    const unsigned int n;
    /// order of the samples; dp/dw and dp/d(position before) of each in contact, empty in flight
    std::vector<unsigned int> order;
    std::vector<std::vector<double>> rate_w, rate_before;
    std::vector<ContactStatus> statuses;
  };
} // namespace vibrocontact
