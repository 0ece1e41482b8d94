#pragma once

#include <vibrocontact/run/analysis.h>

#include <string>

namespace vibrocontact
{
  /// sweep/transient/3 in the folder of the results: where a case writes.
  std::string case_folder(const AnalysisRun &on, unsigned int k);

  /// Runs an analysis through the cases of its sweep: share_cases() with chunks of one case, so that any number of ranks
  /// gives the same numbers.
  ///
  /// What a case came to is kept beside its folder (sweep/transient/3.case) until the sweep has come to its end: a resumed
  /// run takes it from there if the case's entries are the same. SIGTERM or SIGINT let each rank end its case or write
  /// its checkpoint, and stop the run (Results::stopped_by). Collective.
  /// @throws InputError if a body of a case cannot be made, or if all cases are refused; ConvergenceError if none has a
  /// result
  void run_sweep(const Analysis &analysis, const AnalysisRun &on);
} // namespace vibrocontact
