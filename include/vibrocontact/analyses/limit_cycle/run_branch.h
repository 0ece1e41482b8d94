#pragma once

#include <vibrocontact/analyses/limit_cycle/cycle_branch.h>
#include <vibrocontact/analyses/transient/probes.h>

#include <nlohmann/json.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace vibrocontact
{
  /// What a branch needs beside its first cycle.
  struct BranchRun
  {
    const Parameters &parameters;
    const TransientParameters &steps;
    /// with its hub held, and the scene of the first cycle
    std::shared_ptr<const ContactPair> held;
    const CycleScene &scene;
    RollingCase constants;
    /// which of spreads_of_contact the first cycle was found with
    unsigned int spread;
    std::vector<Probe> probes;
    /// hears of the points found so far, in the order in which they were found, so that a killed run keeps them
    std::function<void(const std::vector<nlohmann::ordered_json> &)> keep;
  };

  /// Follows a cycle over Limit cycle/Branch/Entry, says so point by point, and compares the onset with where the growth of the root
  /// that it began from is zero. Nothing but messages is written.
  /// @return branch_json()
  nlohmann::ordered_json run_branch(const BranchRun &run, const LimitCycle &start);
} // namespace vibrocontact
