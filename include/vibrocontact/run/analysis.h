#pragma once

#include <vibrocontact/analyses/transient/state_recorder.h>
#include <vibrocontact/base/entries_read.h>
#include <vibrocontact/output/answers.h>
#include <vibrocontact/output/results.h>
#include <vibrocontact/run/measured_data.h>
#include <vibrocontact/run/prepare_bodies.h>
#include <vibrocontact/run/sweep_cases.h>
#include <vibrocontact/run/swept_analysis.h>
#include <vibrocontact/run/varied_cases.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// The transient that a recorder of a program's own follows.
  struct RecordedTransient
  {
    const Parameters &parameters;
    const ContactPair &pair;
    const PointLaws<NormalLaw> &law;
    /// of the results
    const std::string &folder;
  };
  /// On rank 0, before the first step; null: nothing to record.
  using RecorderMaker = std::function<std::unique_ptr<StateRecorder>(const RecordedTransient &)>;

  /// What an analysis runs on.
  struct AnalysisRun
  {
    const Parameters &parameters;
    const MeshedBodies &bodies;
    /// of section Identification, if something needs them
    const std::optional<MeasuredData> &measured;
    /// of this analysis; no cases: nothing is swept
    const SweepCases &sweep;
    /// of the results
    const std::string &folder;
    /// whether an earlier run in the folder is continued
    bool resume;
    Results &results;
    /// write what there is, at once or if the last time is a while ago
    std::function<void()> save, save_sometimes;
    /// of a transient, beside the shipped ones
    const std::vector<RecorderMaker> &recorders;
  };

  /// One row of the table of analyses (run/tables.h).
  struct Analysis
  {
    /// name, help and number of bodies, as the entry Analyses knows it
    AnalysisType type;
    /// Adds the entries that it reads: those whose value can change what it computes, given the others.
    void (*reads)(EntriesRead &, const Parameters &);
    /// Computes and writes; failures stand in the results. Collective.
    void (*run)(const AnalysisRun &);
    /// A resumed run goes on from its checkpoint, also if it had come to its end: that may be later now.
    bool continues;
    /// what its objects in results.json answer
    std::vector<AnswerKind> answers;
    /// With AnalysisType::sweep_section: begins a sweep, in place of `run`, see run_sweep(); swept_runs() for most. Collective.
    std::function<std::unique_ptr<SweptAnalysis>(const AnalysisRun &)> swept = {};
    /// Cases about that of the file that it asks for beside its run, which `swept` takes; none. May be null.
    std::optional<Variations> (*variations)(const Parameters &) = nullptr;
    /// The analysis that it begins at the end of; empty: none. That one continues, so that a resumed run computes this one again. May
    /// be null.
    std::string (*begins_after)(const Parameters &) = nullptr;
  };
} // namespace vibrocontact
