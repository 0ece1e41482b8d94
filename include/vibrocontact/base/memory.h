#pragma once

#include <vibrocontact/base/exceptions.h>

#include <mpi.h>

#include <string>

namespace vibrocontact
{
  /// Memory that this process and its like on the same machine may still take.
  struct MemoryLeft
  {
    /// [byte]; infinite if nothing can be told
    double bytes;
    /// what sets the limit: "the machine", "its control group (/sys/fs/cgroup/box/memory.max)", "ulimit -v"
    std::string limit;
  };

  /// The least of what the machine has (MemAvailable), what the control groups of this process leave (version 1 and 2,
  /// each on the way up; pages of files that can be dropped count as free), and the process' own address space.
  /// @param root for tests: where /proc and /sys stand
  MemoryLeft memory_left(const std::string &root = "");

  /// Gives the machine back what this process has freed but still holds: the patterns of an assembly, before the factors.
  void return_free_memory();

  /// "8.3 GB"
  std::string bytes_text(double bytes);

  /// What the machine cannot do, whichever lines of the file ask for it: names none.
  class MachineError : public InputError
  {
  public:
    using InputError::InputError;
  };

  /// What a user can do about too little of it.
  constexpr char ways_to_less_memory[] = "take one rank, a coarser mesh or a lower degree, a beam rail in "
                                         "place of a solid one, or a larger machine";

  /// Whether the machine of each rank leaves what its ranks need for a stage. Collective.
  /// @param bytes of this rank
  /// @return one sentence if it does not: what is needed, what is left, and what sets the limit; empty if it does
  std::string memory_shortage(const std::string &stage, double bytes, MPI_Comm communicator);
} // namespace vibrocontact
