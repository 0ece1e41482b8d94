#pragma once

#include <vibrocontact/analyses/transient/contact_stepper.h>
#include <vibrocontact/contact/friction_of_speed.h>
#include <vibrocontact/contact/newton_jacobian.h>

#include <vector>

namespace vibrocontact
{
  /// Changes of the state that a step of the transient starts from or ends in (DynamicState), one per column.
  struct StateChanges
  {
    /// n_modes rows each
    DenseMatrix q, v, modal_force;
    /// on the points of StepOnPoints, 3 rows for each
    DenseMatrix R, residual_displacement;
    /// one per column [m]
    std::vector<double> approach;
  };

  /// The constant parts of a step on those points of the grid that its derivatives are on.
  struct StepOnPoints
  {
    /// ascending
    std::vector<unsigned int> points;
    /// StepMatrices::shapes.basis, by_displacement, by_velocity on their rows; 3 n_points x rank
    DenseMatrix basis, by_displacement, by_velocity;
    /// residual flexibility among them; 3 n_points square [m/N]
    DenseMatrix flexibility;
    /// rows of gap and slip per approach; 3 n_points [-, 1/s]
    std::vector<double> by_approach;

    StepOnPoints(const ContactStepper &stepper, const std::vector<unsigned int> &points);
    unsigned int n_points() const { return points.size(); }
  };

  /// What a step went through, as far as its length matters in it.
  struct StepEnds
  {
    /// amplitudes, velocities and all modal forces (constant loads, too) of the beginning, those forces of the end; n_modes each
    std::vector<double> q, v;
    DenseVector modal_force, next_modal_force;
    /// change of the residual displacements over the step; 3 n of the whole grid [m]
    DenseVector residual_change;
  };

  /// A change of the length of steps, the same in all columns.
  struct LengthChange
  {
    /// derivatives of the steps of the modes by their length
    const std::vector<ModalStep> &by_length;
    /// [s]
    double length;
  };

  /// The derivative of one time step (ContactStepper) at the state that it ended in. In place of the contact problem stands its
  /// linearisation (NewtonJacobian), factorised: no step is made twice. Exact unless a point is on the border between
  /// two of open, stick and slip. Friction that follows the slip speed does so in the linearisation, too,
  ///
  ///   dT = ... + r N (dmu/ds) ds,     s: the slip without the rate of the residual displacements (friction_of_speed.h)
  ///
  /// For laws without a jump between rest and sliding, bodies without poles and rests that relax, and a hub without mass.
  class StepDerivative
  {
  public:
    /// Right after stepper.advance(); both are referred to. @pre no other point is in contact
    /// @param residual_change of the residual displacements over the step; 3 n of the whole grid [m]
    /// @throws ConvergenceError if the Jacobian is singular
    StepDerivative(const ContactStepper &stepper, const StepOnPoints &on_points,
                   const DenseVector &residual_change);

    /// changes <- those at the end of the step. @param change and ends of a step that becomes longer; null: it does not
    void advance(StateChanges &changes, const LengthChange *change = nullptr,
                 const StepEnds *ends = nullptr) const;

  private:
    void take_speed_dependence(const DenseVector &residual_change);
    /// Of force columns among the active points, into the tangential rows of the Jacobian.
    void add_speed_dependence(const DenseMatrix &response);

    const ContactStepper &stepper;
    const StepOnPoints &on_points;
    NewtonJacobian J;
    /// places of the active points among the points
    std::vector<unsigned int> active;
    bool force_given;
    /// of each active point; empty: friction does not follow the speed
    std::vector<SpeedDependence> by_speed;
    DenseMatrix factors;
  };

  /// Derivatives of steps by their length, from steps that are longer and shorter by half of `difference` [s].
  std::vector<ModalStep> steps_by_length(const std::vector<ModalStep> &longer,
                                         const std::vector<ModalStep> &shorter, double difference);
} // namespace vibrocontact
