#pragma once

namespace vibrocontact
{
  /// While one lives, SIGTERM and SIGINT do not end the program but are kept for whoever asks; each a second
  /// time ends it at once. Before and after, they end it as usual. Of several alive, all hear of a signal.
  class StopSignals
  {
  public:
    StopSignals();
    ~StopSignals();
    StopSignals(const StopSignals &) = delete;
    StopSignals &operator=(const StopSignals &) = delete;
    /// Number of the signal that came, 0: none.
    int received() const;
  };
} // namespace vibrocontact
