#pragma once

#include <vibrocontact/analyses/periodic/response_curve.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// A curve with what is told about it.
  struct ResponseCase
  {
    BalanceSettings settings;
    std::string law;
    ResponseCurve curve;
  };

  /// analyses.response of results.json, or one of its variants. Folds are named by the unit of the parameter: folds_Hz, folds_N,
  /// folds_m.
  nlohmann::ordered_json response_json(const ResponseCase &solved, const std::string &table);

  /// response.csv: frequency_Hz, amplitude_m, stable, multiplier_abs, and more behind them; in order along the branch.
  void write_response_table(const ResponseCase &solved, const std::string &file_name);

  /// What the terminal ends with about analyses.response of results.json, see Answer.
  std::vector<std::string> response_answer(const nlohmann::ordered_json &curve);
} // namespace vibrocontact
