#pragma once

#include <vibrocontact/analyses/limit_cycle/basins.h>
#include <vibrocontact/analyses/limit_cycle/cycle_scene.h>
#include <vibrocontact/run/analysis.h>

#include <vector>

namespace vibrocontact
{
  /// Which of the cycles found motions go to that start between them (Limit cycle/Basins), said start by start, into the object
  /// `limit_cycle_basins` of the results, limit_cycle_basins.csv and limit_cycle_basin_paths.csv. Starts from which none wins are refused.
  void run_basins(const AnalysisRun &on, const CycleScene &scene, const TransientParameters &steps,
                  const std::vector<CycleOfBasin> &cycles);
} // namespace vibrocontact
