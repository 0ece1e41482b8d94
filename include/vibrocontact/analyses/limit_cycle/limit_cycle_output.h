#pragma once

#include <vibrocontact/analyses/limit_cycle/limit_cycle.h>
#include <vibrocontact/analyses/transient/probes.h>
#include <vibrocontact/base/table.h>

#include <nlohmann/json.hpp>

#include <array>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// A quantity at the ends of the steps of a period.
  struct CycleSignal
  {
    /// with its unit, as column of a table
    std::string name;
    std::vector<double> values;

    double mean() const;
    /// half the distance from least to largest
    double amplitude() const;
    /// about the mean
    double rms() const;
  };

  /// A period of a cycle.
  struct CyclePeriod
  {
    std::vector<double> time;
    /// of each contact the normal force and the tangential ones on its first body, in its own directions
    std::vector<CycleSignal> forces;
    /// of all contacts
    CycleSignal stick_points, contact_points;
    /// powers: taken by friction, brought by the creepage, into the modes of body 1 [W]
    CycleSignal friction_power, creepage_power, power_into_body_1;
    /// velocities of the probes [m/s]
    std::vector<CycleSignal> probes;
  };

  /// Goes once more through a cycle that was found.
  /// @throws ConvergenceError, InputError if the contact reaches the end of its grid
  CyclePeriod listen_to_cycle(CycleMap &map, const LimitCycle &cycle, const ContactPair &pair,
                              const ContactSections &sections, const std::vector<Probe> &probes);

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

  std::vector<std::string> limit_cycle_search_answer(const nlohmann::ordered_json &search);
  std::vector<std::string> limit_cycle_answer(const nlohmann::ordered_json &cycles);
} // namespace vibrocontact
