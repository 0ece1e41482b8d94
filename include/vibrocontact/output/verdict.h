#pragma once

#include <vibrocontact/output/results.h>

#include <string>

namespace vibrocontact
{
  /// On the screen and in results.json: what is doubtful, though the analysis that runs did converge.
  void doubt(const std::string &text, Results &results);
  /// The same of what did not converge; exit code 2. Numbers of the analysis are kept.
  void refuse(const std::string &text, Results &results);
} // namespace vibrocontact
