#pragma once

#include <vibrocontact/base/declared_parameters.h>
#include <vibrocontact/base/parameter_file.h>
#include <vibrocontact/output/results.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// The output folder of a run. Made only after the input has been checked, so that wrong input leaves
  /// nothing: input.prm (bytes as given), used.prm (every value used), log.txt (from here on, with all said
  /// before), results.json and .vibrocontact_files, the list of what the run wrote. What an earlier run
  /// listed there is removed first, so that no old table stands beside new ones; no other file ever is, nor
  /// the parameter file itself when it is the input.prm of its own output folder.
  ///
  /// One run at a time, see FolderLock.
  ///
  /// results.json is there from the beginning and follows the run, so that the folder of a run that was
  /// killed says so ("complete": false). All functions are collective; rank 0 works.
  class RunRecord
  {
  public:
    /// @param used what used.prm holds  @param resumed results of the earlier run in the folder that this one continues: all its files stay;
    /// null: a new run
    /// @throws InputError on every rank if the folder cannot be written to
    RunRecord(const std::string &folder, const ParameterFile &file, const DeclaredParameters &used,
              const Results *resumed = nullptr);

    /// Writes results.json and the list. @throws OutputError
    void save(const Results &results, double wall_seconds);
    /// The same, but at most once a second: after each case of a long sweep.
    void save_sometimes(const Results &results, double wall_seconds);
    /// Input that turns out to be wrong after all (contact reaches the edge of its grid): removes what this
    /// run wrote. A resumed run leaves all to the next try.
    void discard() const;

    const std::string folder;

  private:
    /// files in the folder that are not older than this run, relative names
    std::vector<std::string> own_files() const;
    void write(const Results &results, double wall_seconds);

    /// the parameter file of this run is the folder's own input.prm
    bool keeps_input = false;
    /// a resumed run: files of the one before, relative names
    std::vector<std::string> earlier_files;
    bool resumes = false;
    /// files older than this are not this run's
    std::filesystem::file_time_type begin;
    std::chrono::steady_clock::time_point last_saved;
  };
} // namespace vibrocontact
