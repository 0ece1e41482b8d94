#pragma once

#include <vibrocontact/run/tables.h>

namespace vibrocontact
{
  /// All that main() does: starts MPI, reads the command line, runs, says what went wrong.
  /// @return exit code: 0 converged, 1 wrong input, 2 not converged, 3 a fault of the program or results that cannot
  ///   be written
  int run_program(const Tables &tables, int argc, char **argv);
} // namespace vibrocontact
