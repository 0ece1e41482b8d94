#pragma once

#include <vibrocontact/analyses/identification/identification.h>
#include <vibrocontact/base/table.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// Fitted receptances on the data's axis.
  FrequencyData fitted_data(const Identification &one, const FrequencyData &data);
  Table chart_table(const std::vector<ChartPole> &chart);
  /// A member of analyses.identification[] without its files.
  nlohmann::ordered_json identification_json(const Identification &one, const FrequencyData &data);

  /// What the terminal ends with about analyses.identification of results.json, see Answer.
  std::vector<std::string> identification_answer(const nlohmann::ordered_json &fits);
} // namespace vibrocontact
