#pragma once

#include <vibrocontact/run/analysis.h>

#include <optional>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// The analysis `identification` with its output: results and identification_data.csv, per fit
  /// identification_poles_<k>.csv, identification_fit_<k>.csv and .uff, identification_chart.csv. Every rank computes the
  /// same, rank 0 writes. Collective.
  void run_identification(const Parameters &parameters, const MeasuredData &measured,
                          const std::string &folder, Results &results);

  /// Its row of the table of analyses.
  Analysis identification_analysis();
} // namespace vibrocontact
