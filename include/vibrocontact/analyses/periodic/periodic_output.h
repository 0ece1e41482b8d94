#pragma once

#include <vibrocontact/analyses/periodic/periodic_error.h>
#include <vibrocontact/base/table.h>
#include <vibrocontact/contact/placed_contacts.h>

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// One solution with what is told about it.
  struct PeriodicCase
  {
    BalanceSettings settings;
    std::string law;
    PeriodicSolution solution;
    PeriodicMotion motion;
    /// to the reference in time, medians over positions of the force within a cell; how many positions gave no solution
    std::optional<PeriodicErrors> errors;
    unsigned int n_phases = 1, failed_phases = 0;
    /// condensation and Newton's method; sampled functions are ready before [s]
    double seconds = 0;
  };

  /// An object of analyses.periodic[] of results.json.
  nlohmann::ordered_json periodic_json(const PeriodicCase &solved);

  /// Of the contacts of a list, by name: their points among all, impulses of a period and largest forces over them.
  nlohmann::ordered_json contacts_json(const PlacedContacts &contacts, const PeriodicMotion &motion);

  /// periodic_<k>.csv: phase, displacement_m, velocity_m_s, contact_force_N of the first point, the others' columns behind
  /// them with the point's number; with friction the tangential ones.
  void write_periodic_table(const PeriodicCase &solved, const std::string &file_name);

  /// periodic_reference.csv: the same columns of the motion that errors are measured against.
  void write_reference_table(const PeriodicReference &reference, const std::string &file_name);

  /// time_bases.csv: the first six functions of Fourier's basis, and of each other family one scaling function for 1, 2, 4, ...
  /// 32 functions, over the phase.
  void write_basis_table(const std::vector<std::string> &families, const TimeBases &bases,
                         const std::string &file_name);

  /// periodic_errors.csv, a line per solution.
  Table periodic_error_table();
  void add_line(Table &table, const PeriodicCase &solved);

  /// What the terminal ends with about analyses.periodic of results.json, see Answer.
  std::vector<std::string> periodic_answer(const nlohmann::ordered_json &solutions);
} // namespace vibrocontact
