#pragma once

#include <vibrocontact/analyses/limit_cycle/harmonic_response.h>
#include <vibrocontact/contact/contact_problem.h>

#include <vector>

namespace vibrocontact
{
  /// Derivatives of what the projections of a point leave, by its forces, its gap and slips, and the slip that friction sees; means
  /// over a period.
  struct MeanLaw
  {
    double by_force[3][3] = {}, by_response[3][3] = {}, by_seen_slip[3][3] = {};
  };

  /// The linear system of CycleBalance order by order, as if the derivatives of the projections stayed what they are in the mean: then
  /// orders do not meet. One complex system of 3 n unknowns for each, bordered by the approach if the normal force is given, all of them by
  /// the frequency.
  class BalancePreconditioner
  {
  public:
    /// @param problem of the points, is referred to @param sees_speed whether friction follows the slip speed
    /// @param by_frequency derivative of the equations by their last unknown @param along direction of the motion; of all unknowns each
    BalancePreconditioner(const HarmonicResponse &response, const std::vector<MeanLaw> &law,
                          const ContactProblem &problem, bool sees_speed, const DenseVector &by_frequency,
                          const DenseVector &along);

    void vmult(DenseVector &to, const DenseVector &from) const;

  private:
    /// of forces and approaches; the frequency becomes zero
    void solve_blocks(const DenseVector &from, DenseVector &to) const;

    const ContactProblem &problem;
    const unsigned int n_rows, n_functions;
    const DenseVector &along;
    std::vector<ComplexMatrix> blocks;
    /// what the frequency changes of forces and approaches
    DenseVector of_frequency;
  };
} // namespace vibrocontact
