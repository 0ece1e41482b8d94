#pragma once

#include <vibrocontact/analyses/limit_cycle/cycle_period.h>
#include <vibrocontact/base/table.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// Lines over a period, and amplitudes of the harmonics.
  Table cycle_table(const CyclePeriod &period);
  Table harmonics_table(const CyclePeriod &period, double frequency);

  /// The object of a cycle in results.json.
  nlohmann::ordered_json cycle_json(const LimitCycle &cycle, const CyclePeriod &period,
                                    unsigned int n_multipliers);
  /// Of a root from which none was found.
  nlohmann::ordered_json failed_json(const LimitCycle &cycle);
  /// How many there are, and of that with the loudest probe `loudest`; none without probes.
  /// @param cycles list of cycle_json() @param search with the list `not_found` of failed_json()
  void add_sums(const nlohmann::ordered_json &cycles, nlohmann::ordered_json &search);
  /// A row for each of both.
  Table cycles_table(const nlohmann::ordered_json &cycles, const nlohmann::ordered_json &not_found);
} // namespace vibrocontact
