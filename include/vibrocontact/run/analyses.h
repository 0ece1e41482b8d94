#pragma once

#include <vibrocontact/run/analysis.h>

namespace vibrocontact
{
  /// All analyses, in the order in which a run does them. Whoever adds one adds its file run_<name>.cc and its row.
  const std::vector<Analysis> &analyses();

  /// Name, help and number of bodies of all.
  std::vector<AnalysisType> analysis_types();

  /// What an analysis reads with these parameters, whether it is listed or not.
  EntriesRead entries_read(const std::string &analysis, const Parameters &parameters);
} // namespace vibrocontact
