#pragma once

#include <vibrocontact/base/parameter_file.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// The output folder of a run. Made only after the input has been checked, so that wrong input leaves
  /// nothing: input.prm (bytes as given), used.prm (every value used), log.txt (from here on, with all said
  /// before), at the end files.txt, the list of what the run wrote. What an earlier run listed there is
  /// removed first, so that no old table stands beside new ones. All functions are called on all ranks; rank
  /// 0 works.
  class RunRecord
  {
  public:
    /// @throws InputError on every rank if the folder cannot be written to
    RunRecord(const std::string &folder, const ParameterFile &file, const dealii::ParameterHandler &prm);

    /// Writes files.txt.
    void finish() const;
    /// Input that turns out to be wrong after all (contact reaches the edge of its grid): removes what this
    /// run wrote, and folders that it made.
    void discard() const;

    const std::string folder;

  private:
    /// files in the folder that are not older than this run, relative names
    std::vector<std::string> own_files() const;
    /// outermost folder that did not exist before; empty if all did
    std::string first_made;
  };

} // namespace vibrocontact
