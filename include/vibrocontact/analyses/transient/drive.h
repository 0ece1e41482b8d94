#pragma once

#include <vibrocontact/analyses/transient/contact_stepper.h>

#include <deal.II/base/parameter_handler.h>

#include <functional>
#include <string>
#include <vector>

namespace vibrocontact
{
  struct RollingCase;
  struct TransientParameters;

  /// What moves the bodies at a time [s].
  using DriveFunction = std::function<Drive(double time)>;

  /// The drive that sections Rolling (by its only case) and Transient describe: constants of Rolling,
  /// replaced by expressions of the time or by columns of the drive table, and roughness.
  ///
  /// The hub's acceleration is the second difference of its displacement over the time step, so that a kink
  /// of a table gives the impulse that belongs to it; at t = 0 it is that of the first step, the body having
  /// the hub's velocity.
  ///
  /// Tables are checked to cover the whole run. What the function gives is finite and a given normal force
  /// positive: it throws otherwise, an InputError that names entry and time.
  /// @throws InputError for what cannot be read or is not covered. Collective.
  DriveFunction drive_function(const TransientParameters &transient, const RollingCase &constant,
                               const PlacedContacts &contacts);

  /// The entries of section Rolling that an expression of section Transient or a column of its table replaces. A
  /// table that cannot be read replaces none. Collective.
  std::vector<std::string> driven_entries(const TransientParameters &transient);

  /// Which loads are given over time, by an expression or a column of the drive table.
  struct LoadOverTime
  {
    bool normal_force = false, hub_displacement = false;
    /// what gives it, for messages; empty: none
    std::string name;
  };
  /// @throws InputError for a table that cannot be read. Collective.
  LoadOverTime load_over_time(const TransientParameters &transient);

  /// Hears of a held hub that jumps, anywhere within the steps (of longer runs, within 20,000 intervals): its acceleration,
  /// a difference over the step, would be a force on the modes of body 1 that grows with shorter steps without end. A jump is found if
  /// it is a tenth of what the hub moves in a sixteenth of a step, against that motion if it is larger than this.
  /// @throws InputError with the time of the jump. Collective.
  void check_hub_does_not_jump(const TransientParameters &transient);

  /// Hears what is wrong with the drive before anything expensive: makes it and looks at it at the ends of
  /// the run's steps, at most 20,000 of them, with the roughness at some hundred, and between them: what varies there by more than a
  /// fifth is refused (of adapted steps, between the shortest ones). Says in the log which load of
  /// section Rolling it replaces by the other kind.
  /// @throws InputError as drive_function() and what it makes. Collective.
  void check_drive(const TransientParameters &transient, const RollingCase &constant,
                   const PlacedContacts &contacts);
} // namespace vibrocontact
