#pragma once

#include <vibrocontact/analyses/stability/stability.h>
#include <vibrocontact/base/table.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// The cases of a run of the analysis `stability`. Without section Stability/Sweep nothing is swept and
  /// values are empty.
  struct StabilityOutcome
  {
    /// StabilityParameters::loss
    std::string loss;
    /// swept entries, e.g. Contact/Lateral position, and their columns, e.g. lateral_position_m
    std::vector<std::string> entries, columns;
    std::vector<StabilityResult> results;
    /// swept values of each result, one per column
    std::vector<std::vector<Table::Cell>> values;
    /// swept values that have no result, and the reason
    std::vector<std::pair<std::vector<Table::Cell>, std::string>> left_out;
  };

  /// All roots of all cases: stability.csv.
  Table stability_table(const StabilityOutcome &outcome);

  /// The paths of the roots that are unstable somewhere in the sweep, or nearest to it in a stable case:
  /// stability_sweep.csv, a row per case and root.
  Table stability_sweep_table(const StabilityOutcome &outcome);

  /// What is unstable in each case: stability_map.csv, a row per case.
  Table stability_map_table(const StabilityOutcome &outcome);

  /// analyses.stability: the unstable roots of the first case, all cases in cases[].
  nlohmann::ordered_json stability_json(const StabilityOutcome &outcome);
  /// `contacts` of analyses.stability: normal force and points of each contact that has a name, at the equilibrium of each
  /// case.
  void add_contacts(const StabilityOutcome &outcome, const PlacedContacts &contacts,
                    nlohmann::ordered_json &json);
  /// Brings it up to date after more cases.
  void add_new_cases(const StabilityOutcome &outcome, nlohmann::ordered_json &json);
  /// `mean_growth` of a sweep of one entry through ascending numbers without gaps: the mean over its range (trapezoids) of the
  /// growth of each path in stability_sweep.csv [1/s]. Over a span of a track it is by how much a motion grows in passing, over
  /// the time of that, if it follows the root: if the passage takes many periods.
  void add_mean_growth(const StabilityOutcome &outcome, nlohmann::ordered_json &json);

  /// What the terminal ends with about analyses.stability of results.json, see Answer.
  std::vector<std::string> stability_answer(const nlohmann::ordered_json &stability);
} // namespace vibrocontact
