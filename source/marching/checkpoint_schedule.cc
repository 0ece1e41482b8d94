#include <vibrocontact/base/run_communicator.h>
#include <vibrocontact/marching/checkpoint_schedule.h>

#include <deal.II/base/mpi.h>

namespace vibrocontact
{
  bool CheckpointSchedule::is_due()
  {
    const bool first = dealii::Utilities::MPI::this_mpi_process(run_communicator()) == 0;
    const auto now = std::chrono::steady_clock::now();
    const bool late = first && interval > 0 && std::chrono::duration<double>(now - last).count() >= interval;
    int both[] = {signals.received(), late};
    MPI_Allreduce(MPI_IN_PLACE, both, 2, MPI_INT, MPI_MAX, run_communicator());
    signal = both[0];
    const bool due = signal != 0 || both[1] != 0;
    if (due)
      last = now;
    return due;
  }
} // namespace vibrocontact
