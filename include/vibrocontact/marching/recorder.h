#pragma once

#include <vibrocontact/base/checkpoint_file.h>

#include <vector>

namespace vibrocontact
{
  /// Whoever follows a march and writes what it saw; what that is each march hands over in its own way (`add()` of
  /// StateRecorder and of ModalConvolutionHistory). Recorders exist on rank 0 only and must not communicate.
  ///
  /// An interrupted and resumed run has to record what an uninterrupted one does: everything that decides
  /// what comes next goes through exchange(); lines go to a RowFile, which is flushed there and only counted
  /// in the checkpoint (see TransientHistory).
  class Recorder
  {
  public:
    virtual ~Recorder() = default;
    /// Into a checkpoint, or back before the first state, see CheckpointFile.
    virtual void exchange(CheckpointFile &file) = 0;
    /// Writes the files for the user. @param at_the_end false: the run was interrupted and may be resumed,
    /// what exchange() relies on stays. @throws OutputError
    virtual void finish(bool at_the_end) = 0;
  };

  /// Those of a march; empty on all ranks but the first.
  using Recorders = std::vector<Recorder *>;
} // namespace vibrocontact
