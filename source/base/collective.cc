#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/exceptions.h>

#include <deal.II/base/mpi.h>

#include <string>

namespace vibrocontact
{
  namespace
  {
    enum class Kind
    {
      none,
      input,
      output,
      convergence,
      other
    };

    struct Failure
    {
      Kind kind = Kind::none;
      std::string text;
    };

    Failure failure_of(const std::function<void()> &action)
    {
      try
      {
        action();
      }
      catch (const InputError &error)
      {
        return {Kind::input, error.what()};
      }
      catch (const OutputError &error)
      {
        return {Kind::output, error.what()};
      }
      catch (const ConvergenceError &error)
      {
        return {Kind::convergence, error.what()};
      }
      catch (const std::exception &error)
      {
        return {Kind::other, error.what()};
      }
      return {};
    }

    void rethrow(const Failure &failure)
    {
      switch (failure.kind)
      {
      case Kind::none:
        return;
      case Kind::input:
        throw InputError(failure.text);
      case Kind::output:
        throw OutputError(failure.text);
      case Kind::convergence:
        throw ConvergenceError(failure.text);
      case Kind::other:
        throw std::runtime_error(failure.text);
      }
    }
  } // namespace

  void on_all_ranks(const std::function<void()> &action, const MPI_Comm communicator)
  {
    namespace MPI = dealii::Utilities::MPI;
    const Failure own = failure_of(action);
    const unsigned int n_ranks = MPI::n_mpi_processes(communicator);
    const unsigned int rank = MPI::this_mpi_process(communicator);
    const unsigned int first = MPI::min(own.kind == Kind::none ? n_ranks : rank, communicator);
    if (first == n_ranks)
      return;
    const auto [kind, text] =
        MPI::broadcast(communicator, std::make_pair(static_cast<int>(own.kind), own.text), first);
    rethrow({static_cast<Kind>(kind), text});
  }

  void on_first_rank(const std::function<void()> &action, const MPI_Comm communicator)
  {
    const bool is_first = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
    on_all_ranks(
        is_first ? action : [] {}, communicator);
  }
} // namespace vibrocontact
