#pragma once

#include <vibrocontact/base/command_line.h>
#include <vibrocontact/run/tables.h>

namespace vibrocontact
{
  /// The whole program between command line and exit code, on all ranks: reads and checks the parameter file,
  /// builds the scene, runs the analyses, writes the results.
  /// @return 0 all converged, 2 something did not (results so far are kept and marked)
  /// @throws InputError before the output folder is made, if the input is wrong
  int run(const Tables &tables, const CommandLine &command_line);
} // namespace vibrocontact
