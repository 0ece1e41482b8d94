#pragma once

#include <vibrocontact/coupled_bodies/quasi_static_loading.h>
#include <vibrocontact/coupled_bodies/rolling_parameters.h>
#include <vibrocontact/marching/drive.h>

#include <memory>
#include <optional>
#include <string>

namespace vibrocontact
{
  struct TransientParameters;

  /// The hub that applies in a transient: RollingParameters::hub, but a load given over time moves a hub that would
  /// be held, without mass.
  /// @throws InputError if the hub's displacement over time is given and the hub is not held
  std::string transient_hub(const std::string &hub, const LoadOverTime &load);

  /// Why it applies, for the terminal.
  std::string transient_hub_text(const std::string &hub, const LoadOverTime &load);

  /// The bodies and what moves them once the hub is at its place.
  struct HubMotion
  {
    /// with the modes of a suspended hub or an axle, or the pair as it was
    std::shared_ptr<const ContactPair> pair;
    /// what becomes of a drive as it was given: by displacement (held, suspended, axle) or by force (massless)
    std::function<DriveFunction(const DriveFunction &)> driven;
    /// of the drive given
    DriveFunction drive;
    /// where it stays [m], and the normal force there [N]; found for a constant load or a suspended hub, else 0
    double place = 0, normal_force = 0;
    /// the contact at the end of a quasi-static loading, from which the march starts
    std::optional<ContactSolution> loaded = {};
  };

  /// Finds the place of the hub in the equilibrium under the drive at t = 0, if it has to be known, and lets the hub
  /// move from there as `hub` says (transient_hub()).
  /// @param loaded the end of a quasi-static loading, in place of that equilibrium; null: none
  /// @param released its force along x and y is taken off
  /// @throws InputError, ConvergenceError
  HubMotion hub_motion(const std::string &hub, const RollingParameters &rolling, const LoadOverTime &load,
                       const ContactSections &contact, const ContactSolverParameters &solver,
                       const std::shared_ptr<const ContactPair> &held, const DriveFunction &drive,
                       const LoadedState *loaded = nullptr, bool released = false);

  /// initial_state() of the held pair, as HubMotion::pair has it.
  DynamicState initial_state(const TransientParameters &transient, const ContactSections &contact,
                             const ContactSolverParameters &solver, const ContactPair &held,
                             const HubMotion &hub);

  /// Amplitudes and velocities of a state of the held pair as those of the suspended one, the hub at rest.
  void hang(const ContactPair &suspended, DynamicState &state);
} // namespace vibrocontact
