#pragma once

#include <functional>
#include <string>

namespace vibrocontact
{
  /// What became of a piece of work in a process of its own.
  struct ChildResult
  {
    /// what the work returned; empty unless it ended well
    std::string output;
    /// empty: it ended well; otherwise what it threw, or how the process ended ("signal 11")
    std::string error;
    /// it ended by a signal: a crash, or more time or memory than it was given
    bool crashed = false;
  };

  /// Does work of other libraries that crash on damaged files in a copy of this process, which ends without touching
  /// what it shares with it (no MPI, no exit handlers; its screen is closed).
  /// @param seconds of processor time and @param bytes of memory beside what the process has, after which it is stopped
  /// @throws std::runtime_error if there can be no further process
  ChildResult run_in_child(const std::function<std::string()> &work, double seconds, double bytes);
} // namespace vibrocontact
