#pragma once

#include <vibrocontact/analyses/identification.h>
#include <vibrocontact/output/table.h>

#include <nlohmann/json.hpp>

namespace vibrocontact
{
  /// Poles of a fit: frequency and damping ratio, lambda, residue of every entry.
  Table poles_table(const Identification &one, const FrequencyData &data);
  /// Fitted receptances on the data's axis.
  FrequencyData fitted_data(const Identification &one, const FrequencyData &data);
  Table chart_table(const std::vector<ChartPole> &chart);
  /// A member of analyses.identification[] without its files.
  nlohmann::ordered_json identification_json(const Identification &one, const FrequencyData &data);
} // namespace vibrocontact
