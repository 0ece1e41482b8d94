#include <vibrocontact/base/run_communicator.h>

namespace vibrocontact
{
  namespace
  {
    MPI_Comm &current()
    {
      static MPI_Comm communicator = MPI_COMM_WORLD;
      return communicator;
    }
  } // namespace

  MPI_Comm run_communicator()
  {
    return current();
  }

  SingleRank::SingleRank() : before(current())
  {
    current() = MPI_COMM_SELF;
  }

  SingleRank::~SingleRank()
  {
    current() = before;
  }
} // namespace vibrocontact
