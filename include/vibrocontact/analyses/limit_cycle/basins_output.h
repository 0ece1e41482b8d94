#pragma once

#include <vibrocontact/analyses/limit_cycle/basins.h>
#include <vibrocontact/base/table.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// A path in the list `starts`, a border in the list `borders` of the object `limit_cycle_basins`.
  nlohmann::ordered_json path_json(const BasinPath &path, const std::vector<CycleOfBasin> &cycles);
  nlohmann::ordered_json border_json(const BasinBorder &border, const std::vector<CycleOfBasin> &cycles);

  /// A row for each start. @param basins the object
  Table starts_table(const nlohmann::ordered_json &basins);
  /// A row for each window of each path.
  Table paths_table(const std::vector<BasinPath> &paths, const std::vector<CycleOfBasin> &cycles);

  /// Last lines of the terminal: who wins between each two cycles.
  std::vector<std::string> basins_answer(const nlohmann::ordered_json &basins);
} // namespace vibrocontact
