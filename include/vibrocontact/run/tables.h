#pragma once

#include <vibrocontact/run/analysis.h>
#include <vibrocontact/run/entry_tables.h>

namespace vibrocontact
{
  /// All families that a program is made of. A program of one's own appends its rows and hands them to run_program()
  /// (run/program.h); nothing else has to know them (doc/extending.md).
  struct Tables : EntryTables
  {
    /// in the order in which a run does them
    std::vector<Analysis> analyses;
    /// what follows a transient beside the shipped recorders
    std::vector<RecorderMaker> recorders;

    std::vector<AnalysisType> analysis_types() const;
  };

  /// What is shipped.
  Tables standard_tables();

  /// What an analysis reads with these parameters, whether it is listed or not.
  EntriesRead entries_read(const std::vector<Analysis> &analyses, const std::string &analysis,
                           const Parameters &parameters);
} // namespace vibrocontact
