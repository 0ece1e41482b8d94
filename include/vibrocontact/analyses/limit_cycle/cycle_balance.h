#pragma once

#include <vibrocontact/analyses/limit_cycle/balance_preconditioner.h>
#include <vibrocontact/analyses/limit_cycle/harmonic_response.h>
#include <vibrocontact/contact/friction_of_speed.h>
#include <vibrocontact/contact/newton_jacobian.h>
#include <vibrocontact/marching/contact_stepper.h>
#include <vibrocontact/numerics/newton_method.h>

#include <memory>
#include <string>
#include <vector>

namespace vibrocontact
{
  class Progress;

  /// A limit cycle by harmonic balance of its contact, a second way beside the steps of CycleMap. Unknown are the contact forces
  /// R of the points as sums of harmonics, with a normal force that is given the approach a, and the frequency w:
  ///
  ///   R - P proj(R, y) = 0,    y = y_rest + Y (R - R_rest) - a,    l . R = force,    p . dR = 0
  ///
  /// The projections are scaled by what rows yield at the highest order (HarmonicResponse::own_compliance() at the first frequency): the
  /// fewer harmonics, the more the solution depends on it.
  ///
  /// Y: HarmonicResponse; proj: the projections of the contact's laws at equal times (ContactResidual), P: harmonics of samples, p: the
  /// direction in which the motion goes on. Newton's method with GMRES (BalancePreconditioner).
  class CycleBalance : public NewtonEquations
  {
  public:
    /// All are referred to. @param at_rest the equilibrium @param points of the grid that may touch, ascending
    CycleBalance(const ContactPair &pair, const ContactSections &contact, const Drive &drive,
                 const DynamicState &at_rest, const PatchShapes &shapes,
                 const std::vector<unsigned int> &points, unsigned int n_harmonics, double tolerance);

    /// Unknowns from samples at equal times, the last one at the end of a period [s].
    /// @param forces 3 n_points of the points each @param approaches [m]
    std::vector<double> unknowns(const std::vector<DenseVector> &forces,
                                 const std::vector<double> &approaches, double period) const;
    /// Unknowns of a motion that a balance with fewer harmonics has, those between zero.
    std::vector<double> extended(const std::vector<double> &x, const CycleBalance &fewer) const;
    double period(const std::vector<double> &x) const { return 2 * dealii::numbers::PI / x.back(); }
    unsigned int n_unknowns() const { return (3 * n + (force_given ? 1 : 0)) * n_functions + 1; }

    /// @return what is left of the projections' harmonics over those of the motion about the equilibrium
    double evaluate(const std::vector<double> &x) override;
    bool keep(const std::vector<double> &x, double size) override;
    bool find_step(bool renew, std::vector<double> &step) override;

    /// States at equal times of a period, as a march has them: what probes and powers need, and gaps of all points.
    /// @param n_steps how many at least
    std::vector<DynamicState> motion(const std::vector<double> &x, unsigned int n_steps);

    /// What the equations leave at the last evaluation; the phase condition leaves nothing.
    DenseVector defect() const;
    /// J at the last evaluation, for GMRES. @return the unit of the frequency in it [rad/s]
    double linearise();
    void vmult(DenseVector &to, const DenseVector &from) const;

    /// why the last evaluation or linear system failed; empty: it did not
    std::string failure;
    mutable unsigned long n_products = 0;
    /// that says how many products there were; null: nobody hears of them
    Progress *progress = nullptr;

  private:
    /// A sample of the projections and its derivatives.
    struct Sample
    {
      NewtonJacobian jacobian;
      /// of its active points; empty: friction does not follow the speed
      std::vector<SpeedDependence> by_speed;
    };

    DenseMatrix forces_of(const DenseVector &x) const;
    /// Gaps and slips by changes of the forces and by the approach among the unknowns.
    DenseMatrix response_to(const DenseVector &x, const DenseMatrix &forces) const;
    /// y less the rate of the residual displacements; empty if friction does not follow the slip speed
    DenseMatrix seen_slips(const DenseMatrix &y, const DenseMatrix &forces) const;
    /// l . R of each column; none if the approach is given
    DenseVector resultants(const DenseMatrix &forces) const;
    DenseMatrix sampled(const DenseMatrix &columns) const;
    DenseMatrix harmonics(const DenseMatrix &samples) const;
    /// Harmonics of what the linearised projections leave of changes, by samples of forces, responses and seen slips.
    DenseMatrix linearised(DenseMatrix forces, const DenseMatrix &response, const DenseMatrix &seen) const;
    std::vector<MeanLaw> mean_law() const;
    double size_of_defect(const std::vector<double> &x);
    /// mu of the points at the slips that friction sees
    void set_friction(const double *seen_slip);
    /// Gaps of points that are not among those that may touch.
    void set_gaps_elsewhere(DynamicState &state) const;
    bool sees_speed() const { return problem.friction_law.any(&FrictionLaw::depends_on_speed); }

    const ContactPair &pair;
    const DynamicState &at_rest;
    const std::vector<unsigned int> points;
    const unsigned int n, n_functions;
    const bool force_given;
    const double tolerance;
    DenseVector rigid;
    HarmonicResponse response;
    /// of the points; A holds what the projections are scaled by
    ContactProblem problem;
    /// gap per approach of all points of the grid
    DenseVector to_force_of_all;
    /// R, gap and slip at rest; 3 n_points
    DenseVector rest_forces, rest_response;
    /// values of the functions at the samples, n_samples x n_functions, and what makes harmonics of samples
    DenseMatrix values, weights;
    // of the last evaluation
    double omega = 0;
    /// R - R_rest; what the projections leave
    DenseMatrix change, left_over;
    DenseVector left_of_resultant;
    std::vector<Sample> samples;
    // of the linear system: derivative by w in its unit, and the direction of the motion
    DenseVector by_frequency, along;
  };
} // namespace vibrocontact
