#pragma once

#include <vibrocontact/analyses/limit_cycle/cycle_search.h>

#include <nlohmann/json.hpp>

#include <functional>
#include <vector>

namespace vibrocontact
{
  /// Follows a cycle over Limit cycle/Branch/Entry, says so point by point, and compares the onset with where the growth of the root
  /// that it began from is zero. Nothing but messages is written.
  /// @param keep hears of the points found so far, in the order in which they were found, so that a killed run keeps them
  /// @return branch_json() @throws ConvergenceError if it cannot begin
  nlohmann::ordered_json
  run_branch(const CycleSearch &search, const SoughtCycle &from,
             const std::function<void(const std::vector<nlohmann::ordered_json> &)> &keep);
} // namespace vibrocontact
