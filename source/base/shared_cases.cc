#include <vibrocontact/base/failure.h>
#include <vibrocontact/base/shared_cases.h>
#include <vibrocontact/base/wall_clock.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <exception>

namespace vibrocontact
{
  namespace
  {
    /// a meeting costs each rank half a chunk of waiting
    constexpr double seconds_between_meetings = 5;
    constexpr unsigned int chunks_between_meetings = 4;

    struct SolvedCase
    {
      unsigned int k = 0;
      PackedCase outcome;
      Failure failure;

      template <typename Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &k &outcome &failure;
      }
    };

    /// A number on rank 0 that every rank reads and changes at once, without rank 0 taking part.
    class SharedCounter
    {
    public:
      explicit SharedCounter(const MPI_Comm communicator)
      {
        const bool is_first = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
        check(MPI_Win_allocate(is_first ? sizeof(int) : 0, sizeof(int), MPI_INFO_NULL, communicator, &value,
                               &window));
        check(MPI_Win_lock_all(MPI_MODE_NOCHECK, window));
        if (is_first)
          exchange(0, MPI_REPLACE);
        check(MPI_Barrier(communicator));
      }
      ~SharedCounter()
      {
        // freeing is collective: after an exception, which may be this rank's alone, it would wait for ever
        if (std::uncaught_exceptions() > 0)
          return;
        MPI_Win_unlock_all(window);
        MPI_Win_free(&window);
      }
      SharedCounter(const SharedCounter &) = delete;
      SharedCounter &operator=(const SharedCounter &) = delete;

      /// Adds one. @return what it was
      unsigned int advance() { return exchange(1, MPI_SUM); }
      unsigned int set(const unsigned int to) { return exchange(to, MPI_REPLACE); }

    private:
      static void check(const int error) { AssertThrowMPI(error); }

      unsigned int exchange(const int operand, const MPI_Op operation)
      {
        int before = 0;
        check(MPI_Fetch_and_op(&operand, &before, MPI_INT, 0, 0, operation, window));
        check(MPI_Win_flush(0, window));
        return before;
      }

      int *value = nullptr;
      MPI_Win window = MPI_WIN_NULL;
    };

    using Arrived = std::function<void(unsigned int, const std::function<PackedCase()> &)>;

    void hand_over(const SolvedCase &solved, const Arrived &arrived)
    {
      arrived(solved.k,
              [&]
              {
                solved.failure.rethrow();
                return solved.outcome;
              });
    }
  } // namespace

  void share_packed_cases(const unsigned int n_cases, const unsigned int chunk,
                          const std::function<std::function<PackedCase(unsigned int)>()> &begin_chunk,
                          const Arrived &arrived, const MPI_Comm communicator)
  {
    namespace MPI = dealii::Utilities::MPI;
    const unsigned int n_chunks = (n_cases + chunk - 1) / chunk;
    const auto solve_chunk = [&](const unsigned int number, const auto &solved_one)
    {
      std::function<PackedCase(unsigned int)> solve;
      const Failure at_begin = failure_of([&] { solve = begin_chunk(); });
      for (unsigned int k = number * chunk; k < std::min(n_cases, (number + 1) * chunk); ++k)
      {
        SolvedCase solved;
        solved.k = k;
        solved.failure = at_begin ? at_begin : failure_of([&] { solved.outcome = solve(k); });
        solved_one(std::move(solved));
      }
    };
    if (MPI::n_mpi_processes(communicator) == 1)
    {
      for (unsigned int number = 0; number < n_chunks; ++number)
        solve_chunk(number, [&](const SolvedCase &solved) { hand_over(solved, arrived); });
      return;
    }

    const bool is_first = MPI::this_mpi_process(communicator) == 0;
    SharedCounter counter(communicator);
    // up to a meeting chunks from 0 to `taken` have been taken, and are solved when all have come
    for (unsigned int taken = 0; taken < n_chunks;)
    {
      std::vector<SolvedCase> own;
      const auto begin = WallClock::now();
      unsigned int number = 0, n_solved = 0;
      taken = n_chunks;
      while ((number = counter.advance()) < n_chunks)
      {
        solve_chunk(number, [&](SolvedCase &&solved) { own.push_back(std::move(solved)); });
        // nothing more to be taken: the others come as well
        if (is_first && ++n_solved >= chunks_between_meetings &&
            seconds_since(begin) > seconds_between_meetings)
          taken = std::min(taken, counter.set(n_chunks));
      }
      std::vector<SolvedCase> all;
      for (std::vector<SolvedCase> &part : MPI::all_gather(communicator, own))
        std::move(part.begin(), part.end(), std::back_inserter(all));
      std::sort(all.begin(), all.end(), [](const SolvedCase &a, const SolvedCase &b) { return a.k < b.k; });
      if (is_first)
        counter.set(taken);
      taken = MPI::broadcast(communicator, taken);
      for (const SolvedCase &solved : all)
        hand_over(solved, arrived);
    }
  }
} // namespace vibrocontact
