#pragma once

#include <vibrocontact/output/results.h>
#include <vibrocontact/run/analysis.h>
#include <vibrocontact/run/meshed_body.h>

#include <string>

namespace vibrocontact
{
  /// The analysis `modes` of one body with its output: results, modes_<body>.csv and, if `fields`, the shapes
  /// on its surface. Shapes that a run computes are kept as files beside the cached modes, so that a run that
  /// finds its modes there has them as well. Collective.
  void run_modes(MeshedBody &body, bool fields, const std::string &folder, Results &results);

  /// Its row of the table of analyses.
  Analysis modes_analysis();
} // namespace vibrocontact
