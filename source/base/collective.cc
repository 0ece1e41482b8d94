#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/failure.h>

#include <deal.II/base/mpi.h>

namespace vibrocontact
{
  void on_all_ranks(const std::function<void()> &action, const MPI_Comm communicator)
  {
    namespace MPI = dealii::Utilities::MPI;
    const Failure own = failure_of(action);
    const unsigned int n_ranks = MPI::n_mpi_processes(communicator);
    const unsigned int rank = MPI::this_mpi_process(communicator);
    const unsigned int first = MPI::min(own ? rank : n_ranks, communicator);
    if (first < n_ranks)
      MPI::broadcast(communicator, own, first).rethrow();
  }

  void on_first_rank(const std::function<void()> &action, const MPI_Comm communicator)
  {
    const bool is_first = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
    on_all_ranks(
        is_first ? action : [] {}, communicator);
  }
} // namespace vibrocontact
