#pragma once

#include <vibrocontact/analyses/limit_cycle/balanced_cycle.h>
#include <vibrocontact/analyses/limit_cycle/cycle_errors.h>
#include <vibrocontact/analyses/limit_cycle/cycle_period.h>
#include <vibrocontact/base/table.h>

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// Lines over a period, and amplitudes of the harmonics.
  Table cycle_table(const CyclePeriod &period);
  Table harmonics_table(const CyclePeriod &period, double frequency);

  /// `stable` of a cycle: null of a neutral one.
  nlohmann::ordered_json stable_json(const std::optional<bool> &is_stable);
  /// The object of a cycle in results.json.
  nlohmann::ordered_json cycle_json(const LimitCycle &cycle, const CyclePeriod &period,
                                    unsigned int n_multipliers);
  /// Its `error_estimate` and, if they are known, the errors.
  void add_errors_json(const CycleErrors &errors, nlohmann::ordered_json &cycle);
  /// The list of its `harmonic_balance`: by harmonic balance, and how far off that is. @param period by steps
  nlohmann::ordered_json balance_json(const std::vector<BalancedCycle> &balanced, const CyclePeriod &period,
                                      double period_length);
  /// A row for each cycle and number of harmonics. @param cycles list of cycle_json()
  Table balance_table(const nlohmann::ordered_json &cycles);
  /// Of a root from which none was found.
  nlohmann::ordered_json failed_json(const LimitCycle &cycle);
  /// How many there are, and of that with the loudest probe `loudest`; without probes of that with the largest normal force.
  /// @param cycles list of cycle_json() @param search with the list `not_found` of failed_json()
  void add_sums(const nlohmann::ordered_json &cycles, nlohmann::ordered_json &search);
  /// A row for each of both.
  Table cycles_table(const nlohmann::ordered_json &cycles, const nlohmann::ordered_json &not_found);
} // namespace vibrocontact
