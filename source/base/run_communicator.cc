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

  LoneRank::LoneRank() : before(current())
  {
    current() = MPI_COMM_SELF;
  }

  LoneRank::~LoneRank()
  {
    current() = before;
  }
} // namespace vibrocontact
