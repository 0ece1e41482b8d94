#pragma once

#include <vibrocontact/analyses/contact_pair.h>
#include <vibrocontact/analyses/modal_step.h>
#include <vibrocontact/contact/contact_solver.h>

#include <functional>
#include <memory>

namespace vibrocontact
{
  /// State of a pair of bodies at one instant: all that the next step depends on.
  struct DynamicState
  {
    double time = 0;
    /// modal amplitudes [m sqrt(kg)] and velocities; n_modes
    std::vector<double> q, v;
    /// forces on body 1 [N] and their residual displacements W~ R [m]; 3 n
    DenseVector R, residual_displacement;
    /// modal forces of the normal and of the tangential forces, Psi^T R [N/sqrt(kg)]; n_modes
    DenseVector normal_modal_force, tangential_modal_force;
    /// powers of the tangential forces [W]: dissipated by friction (>= 0), given to the bodies by the
    /// creepage and by the transport -V R . du/dx
    double friction_power = 0, creepage_power = 0, transport_power = 0;
    /// how the contact was solved at this instant: status, gap and slip, approach
    ContactSolution contact;
  };

  /// Fills what follows from q, v, R: modal forces and W~ R.
  void complete(const ContactPair &pair, DynamicState &state);

  /// Fills the powers of a state from its forces, its slip (contact.y) and the rigid slip (3 n, [m/s]); what
  /// the slip is beside the rigid part, the modal velocities and the residual rate (3 n, [m/s]) is the
  /// transport.
  void set_powers(const ContactPair &pair, const DenseVector &rigid_slip, const DenseVector &residual_rate,
                  DynamicState &state);

  /// Longest step for which reactions that are linear in the step do not ring, 2.7 sqrt(W~ / (Psi Psi^T)),
  /// the least over the normal rows of the contact points (doc/theory.md, "Time steps") [s]; infinite without
  /// modes, 0 for a rigid point.
  double longest_quiet_step(const ContactPair &pair);

  /// What moves the bodies during a step, at its end.
  struct Drive
  {
    Creepage creepage;
    /// given normal force [N], or 0 if the approach is given [m]
    double normal_force = 0, approach = 0;
    /// added to the undeformed gap [m]; n, empty: none (roughness)
    std::vector<double> gap;
  };

  /// One time step after another on the reduced pair (errata, "One discrete contact problem", "Time
  /// integration").
  ///
  /// The modes advance by their ModalStep, the contact points have no mass: the reactions at the end of the
  /// step solve the contact problem
  ///
  ///   gap  = g + (Psi q1 + W~ R1)_n - approach
  ///   slip = V (creepage) + V d/dx (Psi q1 + W~ R1)_t + (Psi v1)_t + (W~ (R1 - R0))_t / h
  ///
  /// in which q1 and v1 are linear in R1, so that its operator
  ///
  ///   A_n = W~_n + (Psi G Psi^T)_n,   A_t = (V d/dx + 1/h) W~_t + V d/dx (Psi G Psi^T)_t + (Psi H Psi^T)_t
  ///
  /// (G, H: gains of displacement and velocity, ModalStep::g1) is constant as long as step and speed are. The
  /// rate of W~ R is differenced backwards: a trapezoidal rate rings.
  class ContactStepper
  {
  public:
    /// @param steps one per mode of the pair, for a step of h [s]; @param speed V [m/s], 0 without rolling
    ContactStepper(const ContactPair &pair, const CreepScheme &scheme, const ContactParameters &contact,
                   const std::vector<ModalStep> &steps, double h, double speed);

    /// state <- state at the end of the step. @return how the contact was solved; not converged: the best
    /// found
    const ContactSolution &advance(DynamicState &state, const Drive &drive, ContactSolver &solver);

  private:
    const ContactPair &pair;
    const CreepScheme &scheme;
    const std::vector<ModalStep> steps;
    const double h, speed;
    /// gap and slip per modal amplitude: Psi_n, V d/dx Psi_t; slip per modal velocity: Psi_t; 3 n x n_modes
    DenseMatrix response_to_q, response_to_v;
    /// gap and slip that never change: undeformed gap and loads; 3 n
    DenseVector constant_response;
    ContactProblem problem;
  };
} // namespace vibrocontact
