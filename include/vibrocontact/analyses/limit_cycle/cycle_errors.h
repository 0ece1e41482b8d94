#pragma once

#include <vibrocontact/analyses/limit_cycle/cycle_period.h>
#include <vibrocontact/analyses/limit_cycle/cycle_scene.h>

#include <algorithm>
#include <string>

namespace vibrocontact
{
  /// What the steps of a cycle did to it, estimated from the same cycle in other steps.
  struct CycleErrors
  {
    /// of that cycle, in a period
    unsigned int n_steps = 0;
    /// by which the cycles are compared
    std::string signal;
    /// relative [-]: of the frequency, of amplitude and first harmonic of the signal
    double frequency = 0, amplitude = 0, first_harmonic = 0;
    /// why they are not known; empty: they are
    std::string failure;
    /// that this took
    double seconds = 0;

    double largest() const { return std::max({frequency, amplitude, first_harmonic}); }
  };

  /// Finds a cycle again in half as many steps, or, where that leads nowhere, in twice as many. The errors are taken for those of
  /// first order, which what is left out by the modes follows its forces with: X(h) - X = C h. Where they fall faster, this is too much.
  /// @param points that may touch, of the map that it was found with
  CycleErrors errors_of_steps(const CycleScene &scene, const TransientParameters &steps,
                              const ContactSolverParameters &solver, const LimitCycleParameters &parameters,
                              const std::vector<unsigned int> &points, const LimitCycle &cycle,
                              const CyclePeriod &period, const std::vector<Probe> &probes);
} // namespace vibrocontact
