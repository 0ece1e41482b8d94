#pragma once

#include <vibrocontact/base/declared_parameters.h>
#include <vibrocontact/run/parameters.h>
#include <vibrocontact/run/sweep_cases.h>
#include <vibrocontact/run/tables.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// Refuses entries that are set but change nothing: those that no analysis of the run reads (entries_read()), with
  /// the analyses that would read them or what would have to hold, and two entries that mean the same with different
  /// values (Rolling/Speed and Road/Speed, Rolling/Hub displacement and Road/Indentation, a roughness and a road).
  /// Set is what an option gives, and what the file gives another value than the default.
  ///
  /// What the file by itself would read and an option has put out of use (an analysis that --set Analyses=... leaves
  /// out, a method that --set replaces) is not refused but returned, for the log; used.prm does without it.
  /// @param overrides options of the command line  @param declared with the values of the run
  /// @param sweeps entries may be read by any of their cases
  /// @throws InputError
  std::vector<std::string>
  entries_out_of_use(const ParameterFile &file, const std::vector<std::string> &overrides,
                     const std::vector<Analysis> &analyses, const Parameters &parameters,
                     const DeclaredParameters &declared, const std::vector<SweepCases> &sweeps);

  /// Refuses a sweep that an analysis of the same file reads (entries_read()) and does not follow: it would silently
  /// stay at a single value. @throws InputError
  void check_reach_of_sweeps(const std::vector<Analysis> &analyses, const Parameters &parameters);
} // namespace vibrocontact
