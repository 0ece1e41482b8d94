#pragma once

#include <vibrocontact/analyses/contact_stepper.h>

namespace vibrocontact
{
  /// Where the energy of a transient goes [J]; sums over the steps.
  ///
  ///   stored = sum (v^2 + w^2 q^2) / 2 + R^T W~ R / 2 + sum of the law's potential
  ///   initial + input = stored + friction + damping + numerical + imbalance
  ///
  /// Powers are taken at the ends of each step and integrated by the trapezoidal rule, the work on the modes
  /// exactly from the change of their amplitudes.
  struct EnergyAccount
  {
    double initial = 0, stored = 0;
    /// work done on the bodies by the creepage, by the transport -V R . du/dx, by hub and roughness, by
    /// constant loads
    double creepage = 0, transport = 0, hub = 0, loads = 0;
    double friction = 0, damping = 0;
    /// what the time scheme takes from the modes
    double numerical = 0;

    double input() const { return creepage + transport + hub + loads; }
    double imbalance() const { return initial + input() - stored - friction - damping - numerical; }
  };

  /// Energy stored in a state [J].
  double stored_energy(const ContactPair &pair, const NormalLaw &law, const DynamicState &state);

  /// Adds the step between two states under their drives.
  void add_step(EnergyAccount &account, const ContactPair &pair, const NormalLaw &law,
                const DynamicState &before, const Drive &drive_before, const DynamicState &after,
                const Drive &drive_after);
} // namespace vibrocontact
