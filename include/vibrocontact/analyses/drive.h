#pragma once

#include <vibrocontact/analyses/contact_stepper.h>

#include <deal.II/base/parameter_handler.h>

#include <functional>

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
  /// Tables are checked to cover the whole run.
  /// @throws InputError for what cannot be read or is not covered. Collective.
  DriveFunction drive_function(const TransientParameters &transient, const RollingCase &constant,
                               const ContactGrid &grid);
} // namespace vibrocontact
