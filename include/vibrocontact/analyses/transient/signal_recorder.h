#pragma once

#include <vibrocontact/analyses/transient/state_recorder.h>
#include <vibrocontact/base/row_file.h>
#include <vibrocontact/marching/probes.h>
#include <vibrocontact/marching/signal_output.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// The velocity of every probe at every step, signals.h5: what spectra, growth rates and sounds need. Also
  /// notices when sticking begins.
  class SignalRecorder : public StateRecorder
  {
  public:
    SignalRecorder(const std::vector<Probe> &probes, const std::string &folder);
    void add(const DynamicState &state) override;
    void exchange(CheckpointFile &file) override;
    void finish(bool at_the_end) override;
    /// Time at which the number of sticking points first changed; that of the last state if it did not [s].
    double change_of_sticking() const { return change; }

  private:
    const std::vector<Probe> &probes;
    RowFile rows;
    std::vector<double> row;
    double change = 0;
    bool changed = false;
    /// sticking points at the beginning; -1: there was no state yet
    int n_stick = -1;
  };

  /// All signals of a finished run: probe velocities of signals.h5, then the resultants of histories.h5 that
  /// vary, the strongest first (times in step with the first).
  /// @throws InputError if the files are not there
  std::vector<NamedSignal> recorded_signals(const std::vector<Probe> &probes, const std::string &folder);
} // namespace vibrocontact
