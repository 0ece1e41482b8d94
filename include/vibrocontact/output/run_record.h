#pragma once

#include <vibrocontact/base/parameter_file.h>

#include <string>

namespace vibrocontact
{
  /// The output folder of a run. Made only after the input has been checked, so that wrong input leaves
  /// nothing: input.prm (bytes as given), used.prm (every value used), log.txt (from here on, with all said
  /// before). Results of an earlier run in the same folder are removed first: results.json, *.csv,
  /// figures/*.png, fields/*.{vtu,pvtu} and *.pvd, as far as that run listed them in `files.txt`. To be
  /// called on all ranks; rank 0 works. Returns the folder.
  std::string begin_run_record(const std::string &folder, const ParameterFile &file,
                               const dealii::ParameterHandler &prm);

  /// Writes files.txt, the list of what this run left in the folder.
  void end_run_record(const std::string &folder);
} // namespace vibrocontact
