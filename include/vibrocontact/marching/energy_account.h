#pragma once

#include <vibrocontact/marching/contact_stepper.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  /// Where the energy of a transient goes [J]; sums over the steps.
  ///
  ///   stored = sum (v^2 + w^2 q^2) / 2 + R^T W~ R / 2 + sum of the law's potential
  ///   initial + input = stored + friction + damping + numerical + imbalance
  ///
  /// A rest that relaxes stores s^T W s / 2 and loses beta s'^T W s' in damping (ContactPair::relaxing).
  /// Powers are taken at the ends of each step and integrated by the trapezoidal rule, the work on the modes
  /// exactly from the change of their amplitudes.
  struct EnergyAccount
  {
    double initial = 0, stored = 0;
    /// largest that initial + input() has been: what there was at the start and what was put in
    double available = 0;
    /// work done on the bodies by the creepage, by the transport -V R . du/dx (of W~ R by central
    /// differences), by hub and roughness, by constant loads and the given force. The hub moves the frame in which modes move:
    /// its acceleration works on them there
    double creepage = 0, transport = 0, hub = 0, loads = 0;
    double friction = 0;
    /// what modes, hub and rests that relax lose, and all that bodies known by poles take, of which nobody knows what they store
    double damping = 0;
    /// what the differences take instead of the continuous equations (doc/theory.md, "Energy account"): the
    /// time scheme from the modes; the upwind d/dx of W~ R against a central one; the backward rate of W~ R
    /// against the mean force over the step, and of rests that relax
    double numerical_modes = 0, numerical_upwind = 0, numerical_rate = 0;
    double numerical() const { return numerical_modes + numerical_upwind + numerical_rate; }

    double input() const { return creepage + transport + hub + loads; }
    double imbalance() const { return initial + input() - stored - friction - damping - numerical(); }
    /// What the account leaves open: the imbalance, or what the differences add (they may take: the damping
    /// of theta > 1/2 is known) [J].
    double open() const { return std::max(std::abs(imbalance()), -numerical()); }
  };

  /// Power that the creep scheme's d/dx of W~ R takes beyond a central difference, V T . (D - D_central) W~ R
  /// [W]; central differences of second order, both neighbours of a loaded point have to be in the grid.
  double upwind_power(const PlacedContacts &contacts, const CreepScheme &scheme, double speed,
                      const DenseVector &R, const DenseVector &residual_displacement);

  /// Energy stored in a state [J].
  double stored_energy(const ContactPair &pair, const PointLaws<NormalLaw> &law, const DynamicState &state);

  /// Adds the step between two states under their drives.
  void add_step(EnergyAccount &account, const ContactPair &pair, const PointLaws<NormalLaw> &law,
                const CreepScheme &scheme, const DynamicState &before, const Drive &drive_before,
                const DynamicState &after, const Drive &drive_after);
} // namespace vibrocontact
