#pragma once

#include <vibrocontact/analyses/stability.h>
#include <vibrocontact/output/table.h>

#include <nlohmann/json.hpp>

namespace vibrocontact
{
  /// All roots of all cases: stability.csv.
  Table stability_table(const std::vector<StabilityResult> &results);

  /// analyses.stability: the unstable roots of the first case, all cases in cases[].
  nlohmann::ordered_json stability_json(const std::vector<StabilityResult> &results);
} // namespace vibrocontact
