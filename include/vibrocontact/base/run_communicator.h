#pragma once

#include <mpi.h>

namespace vibrocontact
{
  /// The ranks that work together now: all of the program, or this one alone while a SingleRank lives.
  MPI_Comm run_communicator();

  /// While it lives, this rank works by itself: what is collective elsewhere (on_first_rank(), files that all ranks read,
  /// checkpoints) is its own, so that a case of a sweep is computed by the code of a run of its own. Things made by all
  /// ranks together (meshes, matrices, factors) stay collective on all ranks and must not be touched.
  class SingleRank
  {
  public:
    SingleRank();
    ~SingleRank();
    SingleRank(const SingleRank &) = delete;
    SingleRank &operator=(const SingleRank &) = delete;

  private:
    const MPI_Comm before;
  };
} // namespace vibrocontact
