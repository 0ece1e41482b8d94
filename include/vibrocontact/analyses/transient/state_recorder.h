#pragma once

#include <vibrocontact/marching/contact_stepper.h>
#include <vibrocontact/marching/recorder.h>

namespace vibrocontact
{
  /// A recorder that sees every state of a transient: of the list in analyses/transient/run_transient.cc or of the
  /// program's own (run/tables.h).
  class StateRecorder : public Recorder
  {
  public:
    /// The state at the beginning, then after every step.
    virtual void add(const DynamicState &state) = 0;
  };
} // namespace vibrocontact
