#pragma once

#include <vibrocontact/analyses/limit_cycle/cycle_branch.h>
#include <vibrocontact/base/table.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// The object `branch` of a cycle in results.json: its ends, folds and points.
  /// @param points in the order of branch.points: cycle_json() with `value`
  nlohmann::ordered_json branch_json(const std::string &entry, const CycleBranch &branch,
                                     const std::vector<nlohmann::ordered_json> &points);
  /// A row per point of every branch. @param cycles list of cycle_json(), at least one with `branch`
  Table branch_table(const nlohmann::ordered_json &cycles);
} // namespace vibrocontact
