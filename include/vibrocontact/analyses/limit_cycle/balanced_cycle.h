#pragma once

#include <vibrocontact/analyses/limit_cycle/cycle_period.h>
#include <vibrocontact/analyses/limit_cycle/cycle_scene.h>

#include <optional>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// A limit cycle as harmonic balance has it, beside the steps of LimitCycle.
  struct BalancedCycle
  {
    unsigned int n_harmonics = 0, n_unknowns = 0;
    bool converged = false;
    /// why not
    std::string message;
    /// [s]
    double period = 0;
    /// what the projections leave over the motion, see CycleBalance; nothing: not a finite number
    std::optional<double> residual;
    unsigned int newton_iterations = 0;
    unsigned long n_products = 0;
    double seconds = 0;
    /// at as many times as the cycle by steps has, or as its harmonics need, if these are more; nothing if it did not converge
    std::optional<CyclePeriod> motion;
  };

  /// Cycles by harmonic balance with several numbers of harmonics, each from the motion of the cycle by steps.
  std::vector<BalancedCycle> balance_cycle(const CycleScene &scene, const LimitCycle &cycle,
                                           const CycleForces &by_steps,
                                           const LimitCycleParameters &parameters,
                                           const std::vector<Probe> &probes);
} // namespace vibrocontact
