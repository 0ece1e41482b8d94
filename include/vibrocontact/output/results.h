#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace vibrocontact
{
  /// results.json: program (version, commit, dealii, ranks), status, wall_s, analyses with one object per
  /// analysis.
  ///
  /// Analyses fill `analyses` ("modes", "quasi_static_rolling", ...) with plain numbers, lists and objects
  /// under the names of the interface, SI units in the names; Hz for frequencies. Filled on every rank,
  /// written by rank 0.
  struct Results
  {
    nlohmann::ordered_json analyses = nlohmann::ordered_json::object();
    /// false as soon as a computation did not converge; exit code 2
    bool converged = true;
    /// sentences about what did not converge; written as "messages" if there are any
    std::vector<std::string> messages;
  };

  /// Text of results.json. @throws dealii::ExceptionBase if a number is not finite
  std::string results_text(const Results &results, double wall_seconds);

  /// Writes results.json whole or not at all; only rank 0 does.
  void write_results(const Results &results, double wall_seconds, const std::string &folder);
} // namespace vibrocontact
