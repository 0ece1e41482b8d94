#pragma once

#include <vibrocontact/analyses/limit_cycle/cycle_period.h>
#include <vibrocontact/analyses/limit_cycle/cycle_scene.h>

#include <algorithm>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// What the steps of a cycle did to it, estimated from the same cycle in other steps.
  struct CycleErrors
  {
    /// of that cycle, in a period
    unsigned int n_steps = 0;
    /// by which the cycles are compared
    std::string signal;
    /// of the frequency over itself, of amplitude and first harmonic of the signal over its amplitude [-]
    double frequency = 0, amplitude = 0, first_harmonic = 0;
    /// why they are not known; empty: they are
    std::string failure;
    /// that this took
    double seconds = 0;

    double largest() const { return std::max({frequency, amplitude, first_harmonic}); }
  };

  /// Finds a cycle again in half as many steps, or, where these are too few, lead nowhere or tell of too large errors, in twice as many.
  /// The errors are taken to fall with the step, as those of the backward differences of the residual displacements do,
  ///
  ///   X(h) - X = C h   ->   |X(h) - X| = |X(h') - X(h)| / |h' / h - 1|
  ///
  /// which is too much where they fall faster. Those of amplitude and first harmonic are at least half of the change of all harmonics.
  /// @param points that may touch, of the map that it was found with; collective
  CycleErrors errors_of_steps(const CycleScene &scene, const LimitCycleParameters &parameters,
                              const std::vector<unsigned int> &points, const LimitCycle &cycle,
                              const CyclePeriod &period, const std::vector<Probe> &probes);
} // namespace vibrocontact
