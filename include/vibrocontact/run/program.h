#pragma once

#include <vibrocontact/run/tables.h>

#include <string>

/// Set by find_package(vibrocontact).
#ifndef VIBROCONTACT_INSTALLED_DATA
#define VIBROCONTACT_INSTALLED_DATA ""
#endif

namespace vibrocontact
{
  /// All that main() does: starts MPI, reads the command line, runs, says what went wrong.
  /// @param data_directory see base/data_directory.h
  /// @return exit code: 0 converged, 1 wrong input, 2 not converged, 3 a fault of the program or results that cannot
  ///   be written
  int run_program(const Tables &tables, int argc, char **argv,
                  const std::string &data_directory = VIBROCONTACT_INSTALLED_DATA);
} // namespace vibrocontact
