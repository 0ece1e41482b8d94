#pragma once

#include <vibrocontact/analyses/transient/contact_stepper.h>
#include <vibrocontact/base/checkpoint_file.h>

#include <memory>
#include <vector>

namespace vibrocontact
{
  /// Whoever follows a transient and writes what it saw: of the list in analyses/transient/run_transient.cc or of the
  /// program's own (run/tables.h). Recorders
  /// exist on rank 0 only and must not communicate.
  ///
  /// An interrupted and resumed run has to record what an uninterrupted one does: everything that decides
  /// what comes next goes through exchange(); lines go to a RowFile, which is flushed there and only counted
  /// in the checkpoint (see TransientHistory).
  class Recorder
  {
  public:
    virtual ~Recorder() = default;
    /// The state at the beginning, then after every step.
    virtual void add(const DynamicState &state) = 0;
    /// Into a checkpoint, or back before the first add(), see CheckpointFile.
    virtual void exchange(CheckpointFile &file) = 0;
    /// Writes the files for the user. @param at_the_end false: the run was interrupted and may be resumed,
    /// what exchange() relies on stays. @throws OutputError
    virtual void finish(bool at_the_end) = 0;
  };

  using Recorders = std::vector<std::unique_ptr<Recorder>>;
} // namespace vibrocontact
