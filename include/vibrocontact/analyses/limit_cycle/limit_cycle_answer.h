#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// Last lines of the terminal: how many cycles were found, and from which roots none.
  std::vector<std::string> limit_cycle_search_answer(const nlohmann::ordered_json &search);
  /// A line per cycle, and of its branch. @param cycles list of cycle_json()
  std::vector<std::string> limit_cycle_answer(const nlohmann::ordered_json &cycles);
} // namespace vibrocontact
