#pragma once

#include <vibrocontact/marching/contact_stepper.h>

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

  /// Displacement of the hub over the time [m], for a load that is given by it. @throws InputError as drive_function(). Collective.
  std::function<double(double)> hub_displacement_over_time(const TransientParameters &transient);
} // namespace vibrocontact
