#pragma once

#include <vibrocontact/contact/friction_of_speed.h>
#include <vibrocontact/contact/newton_jacobian.h>
#include <vibrocontact/marching/contact_stepper.h>

#include <complex>
#include <vector>

namespace vibrocontact
{
  /// Changes of the state that a step of the transient starts from or ends in (DynamicState), one per column.
  struct StateChanges
  {
    /// n_modes rows each
    DenseMatrix q, v, modal_force;
    /// states of the poles and what the contact feeds into them, real parts above imaginary ones; 2 n_poles rows each
    DenseMatrix poles, pole_force;
    /// residual displacements along the surface that the next rate is taken from (ContactStepper::reference_of_rate()), on the points
    /// of StepOnPoints; 2 n_points rows [m]
    DenseMatrix rate_reference;
    /// one per column [m]
    std::vector<double> approach;
    /// forces on those points, 3 n_points rows, and on the shapes, rank rows, of an end alone [N]
    DenseMatrix R, shape_force;

    unsigned int n_columns() const { return approach.size(); }
  };

  /// The constant parts of a step on some points of the grid: those in contact at some time of the steps whose derivatives are taken.
  struct StepOnPoints : MovingShapes
  {
    /// ascending
    std::vector<unsigned int> points;
    /// StepMatrices::by_poles and into_poles of the shapes that are left; rank x 2 n_poles
    DenseMatrix by_poles, into_poles;
    /// residual displacements along the surface by forces; 2 n_points x 3 n_points [m/N]
    DenseMatrix slip_flexibility;
    /// ContactStepper::reference_of_rate() is ahead of the residual displacement by what the rate makes of it in this time [s]
    double lead;
    /// rows of gap and slip per approach; 3 n_points [-, 1/s]
    std::vector<double> by_approach;

    StepOnPoints(const ContactStepper &stepper, const std::vector<unsigned int> &points);
    unsigned int n_points() const { return points.size(); }
    /// modal_force and pole_force of changes <- those of their shape_force
    void feed(StateChanges &changes) const;
  };

  /// What a step went through, as far as its length matters in it.
  struct StepEnds
  {
    /// amplitudes, velocities and all modal forces (constant loads, too) of the beginning, those forces of the end; n_modes each
    std::vector<double> q, v;
    DenseVector modal_force, next_modal_force;
    /// the same of the poles and what is fed into them; n_poles each
    std::vector<std::complex<double>> poles, pole_force, next_pole_force;
    /// of the residual displacements, of the step; 3 n of the whole grid [m/s]
    DenseVector residual_rate;
  };

  /// A change of the length of steps, the same in all columns.
  struct LengthChange
  {
    /// derivatives of the steps of modes and poles by their length
    const std::vector<ModalStep> &modes_by_length;
    const StepWeights &poles_by_length;
    /// [s]
    double length;
  };

  /// The derivative of one time step (ContactStepper) at the state that it ended in. In place of the contact problem stands its
  /// linearisation (NewtonJacobian), factorised: no step is made twice. Exact unless a point is on the border between
  /// two of open, stick and slip. Friction that follows the slip speed does so in the linearisation, too,
  ///
  ///   dT = ... + r N (dmu/ds) ds,     s: the slip without the rate of the residual displacements (friction_of_speed.h)
  ///
  /// Changes are those on the points that it stands on, before which it cannot advance any.
  /// For laws without a jump between rest and sliding, rests that follow at once, and a hub without mass.
  class StepDerivative
  {
  public:
    /// Right after stepper.advance(); stepper and poles are referred to.
    /// @param poles of the pair [1/s] @param residual_rate of the residual displacements, of the step; 3 n of the whole grid [m/s]
    /// @throws ConvergenceError if the Jacobian is singular
    StepDerivative(const ContactStepper &stepper, const std::vector<std::complex<double>> &poles,
                   const DenseVector &residual_rate);

    /// of the grid, ascending
    const std::vector<unsigned int> &points_in_contact() const { return points; }
    /// The points that changes are on from now on, is referred to. @pre those in contact are among them
    void stand_on(const StepOnPoints &these);

    /// changes <- those at the end of the step. @param change and ends of a step that becomes longer; null: it does not
    void advance(StateChanges &changes, const LengthChange *change = nullptr,
                 const StepEnds *ends = nullptr) const;
    /// The same of blocks of columns, but for R, by contact_response(): cheaper for more columns than that has.
    void advance_many(std::vector<StateChanges> &blocks) const;

  private:
    void take_speed_dependence(const DenseVector &residual_rate);
    /// Of force columns among the points in contact, into the tangential rows of the Jacobian.
    void add_speed_dependence(const DenseMatrix &response);
    /// q, v and poles at the end of the step, without the forces there.
    void advance_modes(StateChanges &changes, const LengthChange *change, const StepEnds *ends) const;
    void advance_poles(StateChanges &changes, const LengthChange *change, const StepEnds *ends) const;
    /// Displacements of the shapes by modes and poles, and their velocities without what forces feed into the poles; rank rows.
    DenseMatrix displacements(const StateChanges &changes) const;
    DenseMatrix velocities(const StateChanges &changes) const;
    /// Of numbers of the modes that of the shapes, which is zero without modes.
    DenseMatrix of_modes(const DenseMatrix &numbers, unsigned int n_columns) const;
    /// What the next rate is taken from, w1 / theta - (1 - theta) / theta times the last reference. @param displacement residual ones at the end of the step @param before the last reference
    DenseMatrix next_reference(DenseMatrix displacement, const DenseMatrix &before) const;
    /// R and approach at the end of the step. @param moved gaps and slips of modes and poles without the forces there; 3 n_points rows
    void solve_contact(const DenseMatrix &moved, StateChanges &changes, const LengthChange *change,
                       const StepEnds *ends) const;
    /// What the forces on the shapes make of modes and poles at the end of the step.
    void add_forces(StateChanges &changes) const;
    /// What the contact makes of its surroundings. Columns: displacements of the shapes and velocities of the loaded ones, both without the forces at
    /// the end of the step, references of the rate and approach before it. Rows: forces on the loaded shapes, residual displacements along the surface and
    /// approach at its end.
    DenseMatrix contact_response() const;

    const ContactStepper &stepper;
    const std::vector<std::complex<double>> &poles;
    const StepOnPoints *on_points = nullptr;
    NewtonJacobian J;
    /// in contact, on the grid; their places among those of on_points
    std::vector<unsigned int> points, active;
    bool force_given;
    /// of each point in contact; empty: friction does not follow the speed
    std::vector<SpeedDependence> by_speed;
    DenseMatrix factors;
  };

  /// Derivatives of steps by their length, from steps that are longer and shorter by half of `difference` [s].
  std::vector<ModalStep> steps_by_length(const std::vector<ModalStep> &longer,
                                         const std::vector<ModalStep> &shorter, double difference);
  StepWeights steps_by_length(StepWeights longer, const StepWeights &shorter, double difference);
} // namespace vibrocontact
