#pragma once

#include <vibrocontact/base/stop_signal.h>

#include <chrono>

namespace vibrocontact
{
  /// What all ranks agree on where a checkpoint may be: rank 0's clock and any rank's signal. While it lives, signals
  /// are kept for it.
  class CheckpointSchedule
  {
  public:
    /// @param interval wall time between checkpoints [s], 0: only at signals
    explicit CheckpointSchedule(const double interval) : interval(interval) {}

    /// Collective. After it, stopped_by() is the same on all ranks.
    bool is_due();
    /// number of the signal, 0: none
    int stopped_by() const { return signal; }

  private:
    const StopSignals signals;
    const double interval;
    int signal = 0;
    std::chrono::steady_clock::time_point last = std::chrono::steady_clock::now();
  };
} // namespace vibrocontact
