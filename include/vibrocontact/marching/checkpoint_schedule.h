#pragma once

#include <vibrocontact/base/stop_signal.h>

#include <chrono>

namespace vibrocontact
{
  /// What all ranks agree on between the steps of a march: rank 0's clock and any rank's signal. While it lives, signals
  /// are kept for it.
  ///
  /// A march of long steps is looked at about every second, also within a block of steps, where no checkpoint may stand.
  /// There it is left at a signal if the one at the block's beginning exists, which is therefore written after every block
  /// that took longer than a second; else the block is finished first.
  class CheckpointSchedule
  {
  public:
    /// @param interval wall time between checkpoints [s], 0: only at signals and after long blocks
    explicit CheckpointSchedule(const double interval) : interval(interval) {}

    /// Until the next look, the same on all ranks.
    unsigned int n_steps() const { return steps; }
    /// Collective; after it, n_steps() and stopped_by() are the same on all ranks.
    /// @param between_blocks whether a checkpoint may stand here
    /// @return whether one is to be written, never within a block
    bool is_due(bool between_blocks = true);
    /// number of the signal at which to leave, 0: none
    int stopped_by() const { return signal; }

  private:
    const StopSignals signals;
    const double interval;
    int signal = 0;
    unsigned int steps = 1;
    /// since the last checkpoint; since the last look
    std::chrono::steady_clock::time_point last = std::chrono::steady_clock::now(), last_look = last;
    /// of the block so far [s]; whether its beginning is stored, or that of the march
    double block_seconds = 0;
    bool beginning_is_stored = true;
  };
} // namespace vibrocontact
