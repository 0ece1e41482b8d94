#include <vibrocontact/base/fault.h>
#include <vibrocontact/base/log.h>

#include <deal.II/base/mpi.h>

#include <chrono>
#include <iostream>
#include <thread>

namespace vibrocontact
{
  int leave_together(const int exit_code, const std::string &message)
  {
    const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    const std::string text = "vibrocontact: " + message;
    if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
    {
      MPI_Request request;
      MPI_Ibarrier(MPI_COMM_WORLD, &request);
      int all_here = 0;
      for (int trial = 0; trial < 300 && !all_here; ++trial)
      {
        MPI_Test(&request, &all_here, MPI_STATUS_IGNORE);
        if (!all_here)
          std::this_thread::sleep_for(std::chrono::milliseconds(10));
      }
      if (!all_here)
      {
        std::cerr << text << " (rank " << rank << ")" << std::endl;
        MPI_Abort(MPI_COMM_WORLD, exit_code);
      }
    }
    if (rank == 0)
      std::cerr << text << std::endl;
    return exit_code;
  }
} // namespace vibrocontact
