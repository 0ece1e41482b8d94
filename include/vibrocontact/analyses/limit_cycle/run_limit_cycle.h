#pragma once

#include <vibrocontact/run/analysis.h>

namespace vibrocontact
{
  /// The row of the table of analyses.
  Analysis limit_cycle_analysis();
} // namespace vibrocontact
