#pragma once

#include <vibrocontact/base/table.h>
#include <vibrocontact/coupled_bodies/quasi_static_rolling.h>

#include <nlohmann/json.hpp>

#include <string>
#include <utility>
#include <vector>

namespace vibrocontact
{
  /// One entry of analyses.quasi_static_rolling.cases[] in results.json.
  nlohmann::ordered_json rolling_case_json(const RollingResult &result);
  /// The same of one of its contacts.
  nlohmann::ordered_json rolling_case_json(const RollingResult &result, const ContactResultants &of);

  /// The patch of contact k in one case, a row per grid point: contact_patch_<case>.csv.
  Table contact_patch_table(const RollingResult &result, const PlacedContacts &contacts, unsigned int k = 0);

  /// Resultants of all cases, the entries of cases[]: rolling.csv.
  Table rolling_table(const nlohmann::ordered_json &cases);

  /// What the terminal ends with about analyses.quasi_static_rolling of results.json, see Answer.
  std::vector<std::string> rolling_answer(const nlohmann::ordered_json &rolling);
} // namespace vibrocontact
