#pragma once

#include <vibrocontact/output/results.h>

#include <string>

namespace vibrocontact
{
  /// Larger estimated errors of the impulse or of the rms force make a march in time a failure [-].
  constexpr double most_step_error = 0.2;
  /// So does what its energy account leaves open, as a share of the energy that there was [-].
  constexpr double most_open_energy = 0.05;

  /// On the screen and in results.json: what is doubtful, though the analysis did converge.
  void doubt(const std::string &text, Results &results);
  /// The same of what did not converge; exit code 2. Numbers of the analysis are kept.
  void refuse(const std::string &analysis, const std::string &text, Results &results);
} // namespace vibrocontact
