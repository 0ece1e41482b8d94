#pragma once

#include <vibrocontact/base/run_communicator.h>

#include <functional>

namespace vibrocontact
{
  /// Runs `action` on every rank (of those that work together, see run_communicator()) and brings the ranks together again: if it throws on any of them, every rank
  /// throws the error of the lowest one that failed, of the same class and with the same text. Without this
  /// a rank that fails alone (a full disk meets rank 0 only) leaves the others waiting in their next
  /// communication.
  ///
  /// What becomes of the classes: see Failure. The action itself must not communicate: a rank that throws
  /// would leave it.
  void on_all_ranks(const std::function<void()> &action, MPI_Comm communicator = run_communicator());

  /// The same for work of rank 0 alone, such as writing a file.
  void on_first_rank(const std::function<void()> &action, MPI_Comm communicator = run_communicator());
} // namespace vibrocontact
