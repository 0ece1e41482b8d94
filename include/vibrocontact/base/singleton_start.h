#pragma once

#include <string>

namespace vibrocontact
{
  /// To be made before MPI_Init and to outlive MPI_Finalize. A singleton (a program started without mpirun) makes Open MPI
  /// start a daemon of its own, which now and then stalls; it needs none to run alone. Open MPI's mode
  /// without the daemon keeps its files under one name for all programs, which then delete each other's: each
  /// gets a temporary folder of its own. Nor does it look for fast networks, of which it needs none and which take Open
  /// MPI 0.2 s to try, unless OMPI_MCA_pml names some. Does nothing under mpirun.
  class SingletonStart
  {
  public:
    SingletonStart();
    ~SingletonStart();
    SingletonStart(const SingletonStart &) = delete;
    SingletonStart &operator=(const SingletonStart &) = delete;

  private:
    std::string folder;
  };
} // namespace vibrocontact
