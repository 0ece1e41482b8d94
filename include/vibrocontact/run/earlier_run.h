#pragma once

#include <vibrocontact/base/declared_parameters.h>
#include <vibrocontact/output/results.h>

#include <string>

namespace vibrocontact
{
  /// What `--resume` finds in the output folder: the results of the analyses that came to their end there.
  /// The transient goes on from checkpoint.h5, see checkpoint.h. Reads only.
  ///
  /// The parameters have to be those of the earlier run (its used.prm) but for where it ends and what it
  /// writes: section Output, End time and Checkpoint interval of Transient and Modal convolution. So have the files that
  /// they name (results.json, input_files), but for tables of section Transient.
  /// @param end_time of the transient, refused if the run is beyond [s]
  /// @throws InputError if there is no run or it had other parameters or files
  Results earlier_results(const std::string &folder, const DeclaredParameters &used, double end_time);
} // namespace vibrocontact
