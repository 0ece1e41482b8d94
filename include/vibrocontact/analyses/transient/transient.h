#pragma once

#include <vibrocontact/analyses/transient/coarse_run.h>
#include <vibrocontact/analyses/transient/drive.h>
#include <vibrocontact/analyses/transient/transient_parameters.h>
#include <vibrocontact/analyses/transient/transient_result.h>
#include <vibrocontact/coupled_bodies/quasi_static_rolling.h>

#include <functional>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// After so many steps the contact solver starts afresh, so that what it keeps from step to step need not
  /// be in a checkpoint: a run that continues there goes the same way bit for bit.
  constexpr unsigned long steps_between_fresh_starts = 50;

  /// Index of the perturbed mode among the labels body:label of modes; their number if none is perturbed.
  /// @throws InputError if there is no such mode, with near ones
  unsigned int perturbed_mode(const TransientParameters &transient, const std::vector<std::string> &labels);

  /// The quasi-static equilibrium of the pair under a drive.
  /// @throws InputError, ConvergenceError
  ContactSolution transient_equilibrium(const ContactSections &contact, const ContactSolverParameters &solver,
                                        const ContactPair &pair, const Drive &drive);

  /// State at time zero, by TransientParameters::initial_state. The quasi-static one is the equilibrium under
  /// the drive at time zero, q = diag(w^-2) Psi^T R, v = 0.
  /// @throws InputError, ConvergenceError
  DynamicState initial_state(const TransientParameters &transient, const ContactSections &contact,
                             const ContactSolverParameters &solver, const ContactPair &pair,
                             const Drive &drive);

  /// The run with twice the step that is marched beside another one.
  struct Companion
  {
    /// as the other's, for with_doubled_step(parameters)
    DriveFunction drive;
    /// at the beginning of a run: the state that it begins with
    CoarseRun run;
  };

  /// Steps from `state` to the end time (Lai et al. 2018, section 5). A step whose contact does not converge
  /// ends the run, with converged = false and the states so far.
  /// @param observe called after every step; false: stop
  /// @param before sums of the run that led to `state`, if it is continued
  /// @param companion follows the run and learns its errors; null: they are not estimated
  TransientResult transient(const TransientParameters &parameters, const ContactSections &contact,
                            const ContactSolverParameters &solver, const ContactPair &pair,
                            const DriveFunction &drive, DynamicState &state,
                            const std::function<bool(const DynamicState &, const TransientResult &)> &observe,
                            const TransientResult &before = {}, Companion *companion = nullptr);
} // namespace vibrocontact
