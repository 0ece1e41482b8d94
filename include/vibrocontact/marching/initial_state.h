#pragma once

#include <vibrocontact/marching/contact_stepper.h>
#include <vibrocontact/marching/drive.h>
#include <vibrocontact/marching/transient_parameters.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// Index of the perturbed mode among the labels body:label of modes; their number if none is perturbed.
  /// @throws InputError if there is no such mode, with near ones
  unsigned int perturbed_mode(const TransientParameters &transient, const std::vector<std::string> &labels);
  /// @throws InputError where theta takes more from the growth of the mode that is perturbed than its damping, and a fifth of it by the end
  void check_theta_keeps_mode(const TransientParameters &parameters, const ContactPair &pair);

  /// The quasi-static equilibrium of the pair under a drive.
  /// @throws InputError, ConvergenceError
  ContactSolution transient_equilibrium(const ContactSections &contact, const ContactSolverParameters &solver,
                                        const ContactPair &pair, const Drive &drive);

  /// State at time zero, by TransientParameters::initial_state. The quasi-static one is the equilibrium under
  /// the drive at time zero, q = diag(w^-2) Psi^T R, v = 0.
  /// @param loaded the contact that it starts from, in place of an equilibrium found here; null: none
  /// @throws InputError, ConvergenceError
  DynamicState initial_state(const TransientParameters &transient, const ContactSections &contact,
                             const ContactSolverParameters &solver, const ContactPair &pair,
                             const Drive &drive, const ContactSolution *loaded = nullptr);
} // namespace vibrocontact
