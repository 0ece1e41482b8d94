#pragma once

#include <vibrocontact/base/declared_parameters.h>
#include <vibrocontact/output/results.h>
#include <vibrocontact/run/parameters.h>

#include <string>

namespace vibrocontact
{
  /// Before anything is made. @throws InputError if `--resume` finds no run in the output folder. Collective.
  void check_earlier_run(const std::string &folder);

  /// What `--resume` finds in the output folder: the results of the analyses that came to their end there.
  /// Marches go on from their checkpoints (marching/march_checkpoint.h). Reads only.
  ///
  /// The parameters have to be those of the earlier run (its used.prm) but for where it ends and what it
  /// writes: section Output, End time and Checkpoint interval of Transient and Modal convolution. So have the files that
  /// they name (results.json, input_files), but for tables of section Transient.
  /// @throws InputError if there is no run, it had other parameters or files, or a march is beyond its end time
  Results earlier_results(const std::string &folder, const DeclaredParameters &used,
                          const Parameters &parameters);
} // namespace vibrocontact
