#include <vibrocontact/base/run_communicator.h>
#include <vibrocontact/marching/checkpoint_schedule.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace vibrocontact
{
  namespace
  {
    /// of wall time between two looks; what longer blocks take is worth a checkpoint [s]
    constexpr double look_seconds = 1;
    constexpr unsigned int most_steps = 1 << 20;
  } // namespace

  bool CheckpointSchedule::is_due(const bool between_blocks)
  {
    const bool first = dealii::Utilities::MPI::this_mpi_process(run_communicator()) == 0;
    const auto now = std::chrono::steady_clock::now();
    const auto since = [&](const auto &before)
    { return first ? std::chrono::duration<double>(now - before).count() : 0.; };
    double shared[] = {double(signals.received()), interval > 0 && since(last) >= interval ? 1. : 0.,
                       since(last_look)};
    MPI_Allreduce(MPI_IN_PLACE, shared, 3, MPI_DOUBLE, MPI_MAX, run_communicator());
    last_look = now;
    const int received = static_cast<int>(shared[0]);
    const double seconds = shared[2];
    if (seconds > look_seconds)
      steps = std::max(1., steps * look_seconds / seconds);
    else if (seconds < look_seconds / 2)
      steps = std::min(2 * steps, most_steps);
    block_seconds += seconds;
    const bool is_long = block_seconds > look_seconds;
    if (!between_blocks)
    {
      if (is_long && beginning_is_stored)
        signal = received;
      return false;
    }
    signal = received;
    block_seconds = 0;
    beginning_is_stored = received != 0 || shared[1] != 0 || is_long;
    if (beginning_is_stored)
      last = now;
    return beginning_is_stored;
  }
} // namespace vibrocontact
