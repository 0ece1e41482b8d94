// An error on one rank is thrown on all of them, with its class and text.
#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/memory.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

using namespace vibrocontact;

namespace
{
  template <typename Error>
  std::string text_thrown(const std::function<void()> &call)
  {
    try
    {
      call();
    }
    catch (const Error &error)
    {
      return error.what();
    }
    return "not thrown";
  }
} // namespace

TEST(CollectiveMpi, WhatTheFirstRankThrowsAllThrow)
{
  EXPECT_EQ(text_thrown<OutputError>([] { on_first_rank([] { throw OutputError("full"); }); }), "full");
  EXPECT_EQ(text_thrown<InputError>([] { on_first_rank([] { throw InputError("wrong"); }); }), "wrong");
  EXPECT_EQ(text_thrown<MachineError>([] { on_first_rank([] { throw MachineError("too large"); }); }),
            "too large");
  EXPECT_EQ(text_thrown<ConvergenceError>([] { on_first_rank([] { throw ConvergenceError("far"); }); }),
            "far");
  EXPECT_EQ(text_thrown<std::runtime_error>([] { on_first_rank([] { throw std::bad_alloc(); }); }),
            "std::bad_alloc");
}

TEST(CollectiveMpi, OnlyTheFirstRankActs)
{
  unsigned int acted = 0;
  on_first_rank([&] { ++acted; });
  EXPECT_EQ(acted, dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0 ? 1u : 0u);
  EXPECT_EQ(dealii::Utilities::MPI::sum(acted, MPI_COMM_WORLD), 1u);
}

TEST(CollectiveMpi, TheLowestRankThatFailsIsHeard)
{
  const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD),
                     last = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) - 1;
  const auto last_fails = [&]
  {
    if (rank == last)
      throw OutputError("rank " + std::to_string(rank));
  };
  EXPECT_EQ(text_thrown<OutputError>([&] { on_all_ranks(last_fails); }), "rank " + std::to_string(last));
  const auto all_fail = [&] { throw OutputError("rank " + std::to_string(rank)); };
  EXPECT_EQ(text_thrown<OutputError>([&] { on_all_ranks(all_fail); }), "rank 0");
}
