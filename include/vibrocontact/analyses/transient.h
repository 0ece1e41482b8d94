#pragma once

#include <vibrocontact/analyses/drive.h>
#include <vibrocontact/analyses/energy_account.h>
#include <vibrocontact/analyses/quasi_static_rolling.h>
#include <vibrocontact/analyses/roughness.h>

#include <deal.II/base/parameter_handler.h>

#include <functional>
#include <string>

namespace vibrocontact
{
  /// `subsection Transient`
  struct TransientParameters
  {
    /// h, end of the run [s]
    double time_step = 1e-6, end_time = 1e-2;
    /// error per step over the size of the vibration, at which the step is halved, see StepLadder; 0: all steps
    /// are equal; otherwise between this and the time step [s]
    double error_tolerance = 0, shortest_step = 0;
    /// "theta method" or "exact propagator"; theta
    std::string integrator = "theta method";
    double theta = 0.5;
    /// "as other forces" or "end of step", see ReactionWeighting
    std::string reaction = "as other forces";
    /// "quasi-static": the equilibrium of section Rolling, at rest in the moving frame; "undeformed": bodies
    /// without stress, apart by initial_gap, body 1 moving with initial_velocity
    std::string initial_state = "quasi-static";
    /// [m]; along z, positive upwards [m/s]
    double initial_gap = 0, initial_velocity = 0;
    /// stated perturbation of the initial state: name of a mode (body:label), its largest displacement in the
    /// contact [m] and velocity [m/s]
    std::string perturbed_mode;
    double perturbation = 0, perturbation_velocity = 0;
    /// expressions of the time t that replace the constants of section Rolling; empty: constant
    std::string longitudinal_creepage, lateral_creepage, spin, normal_force, hub_displacement;
    /// CSV file that does the same, columns time_s and any of longitudinal_creepage, lateral_creepage, spin_1_m,
    /// normal_force_N, hub_displacement_m
    std::string drive_table;
    RoughnessParameters roughness;
    /// distance of the lines of the histories [s], 0: every step
    double history_interval = 0;
    /// wall time between checkpoints [s], 0: only when the run is stopped and at its end
    double checkpoint_interval = 300;

    void declare_parameters(dealii::ParameterHandler &prm);
    /// @throws InputError for combinations that make no sense
    void check() const;
  };

  /// After so many steps the contact solver starts afresh, so that what it keeps from step to step need not be
  /// in a checkpoint: a run that continues there goes the same way bit for bit.
  constexpr unsigned long steps_between_fresh_starts = 50;

  /// Sums over a run and how it went.
  struct TransientResult
  {
    unsigned long steps = 0, iterations = 0, factorisations = 0, fallbacks = 0;
    /// steps that were repeated with half their length; the next step is 2^rung of the shortest
    unsigned long rejected = 0;
    unsigned int rung = 0;
    double time = 0, seconds = 0;
    /// normal impulse over the run [Ns]
    double impulse = 0;
    /// least gap seen, negative: penetration [m]
    double smallest_gap = 0;
    EnergyAccount energy;
    bool converged = true;
    /// why it did not
    std::string message;
  };

  /// One ModalStep per mode of the pair, for a step of h [s].
  std::vector<ModalStep> modal_steps(const TransientParameters &parameters, const ContactPair &pair,
                                     double h);

  /// State at time zero, by TransientParameters::initial_state. The quasi-static one is the equilibrium under
  /// the drive at time zero, q = diag(w^-2) Psi^T R, v = 0.
  /// @throws InputError, ConvergenceError
  DynamicState initial_state(const TransientParameters &transient, const ContactParameters &contact,
                             const ContactSolverParameters &solver, const ContactPair &pair,
                             const Drive &drive);

  /// Steps from `state` to the end time (Lai et al. 2018, section 5). A step whose contact does not converge
  /// ends the run, with converged = false and the states so far.
  /// @param observe called after every step; false: stop
  /// @param before sums of the run that led to `state`, if it is continued
  TransientResult transient(const TransientParameters &parameters, const ContactParameters &contact,
                            const ContactSolverParameters &solver, const ContactPair &pair,
                            const DriveFunction &drive, DynamicState &state,
                            const std::function<bool(const DynamicState &, const TransientResult &)> &observe,
                            const TransientResult &before = {});
} // namespace vibrocontact
