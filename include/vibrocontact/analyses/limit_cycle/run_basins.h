#pragma once

#include <vibrocontact/analyses/limit_cycle/basins.h>
#include <vibrocontact/analyses/limit_cycle/cycle_search.h>

#include <vector>

namespace vibrocontact
{
  /// Which of the cycles found motions go to that start between them (Limit cycle/Basins), said start by start, into the object
  /// `limit_cycle_basins` of the results, limit_cycle_basins.csv and limit_cycle_basin_paths.csv. Starts from which none wins are refused.
  void run_basins(const CycleSearch &search, const std::vector<CycleOfBasin> &cycles);
} // namespace vibrocontact
