#pragma once

#include <vibrocontact/analyses/periodic/periodic_motion.h>
#include <vibrocontact/analyses/periodic/shooting.h>

#include <vector>

namespace vibrocontact
{
  /// The motion in time that solutions are measured against, found by shooting (shooting.h) and sampled at equal phases.
  struct PeriodicReference
  {
    ShootingSolution solution;
    /// [m], [m/s], [N] of the contact point
    std::vector<double> displacement, velocity, contact_force;
  };

  /// @throws ConvergenceError; InputError for bodies with friction or several contact points
  PeriodicReference periodic_reference(const ForcedBody &body, const std::shared_ptr<const NormalLaw> &law,
                                       const HarmonicForce &force, unsigned int n_samples);

  /// rms of a difference over the rms of the reference, at its samples [-]; impulse and energy norm: relative
  struct PeriodicErrors
  {
    double displacement = 0, velocity = 0, contact_force = 0, impulse = 0, energy_norm = 0;
    /// of the displacement in the middle of the cells [k/N, (k+1)/N) only, where functions that are constant on them are
    /// best
    double midpoints = 0;
  };

  PeriodicErrors errors_of(const PeriodicBalance &balance, const PeriodicSolution &solution,
                           const PeriodicMotion &motion, const PeriodicReference &reference);

  /// Entry by entry; @param errors at least one
  PeriodicErrors median(const std::vector<PeriodicErrors> &errors);
} // namespace vibrocontact
