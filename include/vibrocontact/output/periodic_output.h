#pragma once

#include <vibrocontact/periodic/periodic_motion.h>

#include <nlohmann/json.hpp>

#include <string>

namespace vibrocontact
{
  /// One solution with what is told about it.
  struct PeriodicCase
  {
    BalanceSettings settings;
    std::string law;
    PeriodicSolution solution;
    PeriodicMotion motion;
    double seconds = 0;
  };

  /// An object of analyses.periodic[] of results.json.
  nlohmann::ordered_json periodic_json(const PeriodicCase &solved);

  /// periodic_<k>.csv: phase, displacement_m, velocity_m_s, contact_force_N of the first point, the others' columns behind
  /// them with the point's number; with friction the tangential ones.
  void write_periodic_table(const PeriodicCase &solved, const std::string &file_name);
} // namespace vibrocontact
