// Cases shared out over the ranks arrive on all of them, in order, as one rank alone computes them.
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/shared_cases.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <thread>

using namespace vibrocontact;

namespace
{
  /// A case that starts from the one before: the further from the begin of its chunk, the more it has summed up.
  struct Sum
  {
    double value = 0;
    std::vector<std::string> names;
    /// computed by
    unsigned int rank = 0;

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &value &names &rank;
    }
  };

  std::vector<Sum> sums(const unsigned int n_cases, const unsigned int chunk, const MPI_Comm communicator,
                        const double seconds = 0)
  {
    std::vector<Sum> result;
    share_cases<Sum>(
        n_cases, chunk,
        [&]
        {
          return [seconds, sum = Sum()](const unsigned int k) mutable
          {
            std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
            sum.value += std::sin(k + 1.);
            sum.names.push_back(std::to_string(k));
            sum.rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
            return sum;
          };
        },
        [&](const unsigned int k, const std::function<Sum()> &outcome)
        {
          EXPECT_EQ(k, result.size());
          result.push_back(outcome());
        },
        communicator);
    return result;
  }
} // namespace

TEST(SharedCasesMpi, AnyNumberOfRanksGivesTheSame)
{
  for (const unsigned int n_cases : {0, 1, 7, 12, 40})
    for (const unsigned int chunk : {1, 3, 50})
    {
      const std::vector<Sum> alone = sums(n_cases, chunk, MPI_COMM_SELF),
                             shared = sums(n_cases, chunk, MPI_COMM_WORLD);
      ASSERT_EQ(alone.size(), n_cases);
      ASSERT_EQ(shared.size(), n_cases);
      double sum = 0;
      for (unsigned int k = 0; k < n_cases; ++k)
      {
        // the first of a chunk is cold
        sum = (k % chunk == 0 ? 0 : sum) + std::sin(k + 1.);
        EXPECT_EQ(alone[k].value, sum) << k;
        EXPECT_EQ(shared[k].value, alone[k].value) << k;
        EXPECT_EQ(shared[k].names, alone[k].names) << k;
        EXPECT_EQ(shared[k].rank, shared[k - k % chunk].rank) << k;
      }
    }
}

TEST(SharedCasesMpi, ARankThatIsFreeTakesTheNextChunk)
{
  // long enough for ranks to meet in between
  const std::vector<Sum> shared = sums(24, 2, MPI_COMM_WORLD, 0.6);
  ASSERT_EQ(shared.size(), 24u);
  std::vector<unsigned int> by_rank(dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD));
  for (const Sum &one : shared)
    ++by_rank.at(one.rank);
  for (const unsigned int n : by_rank)
    EXPECT_GE(n, 24 / by_rank.size() - 4);
}

TEST(SharedCasesMpi, ErrorsKeepTheirClassAndTheOthersGoOn)
{
  std::vector<std::string> heard;
  share_cases<double>(
      9, 2,
      []() -> std::function<double(unsigned int)>
      {
        return [](const unsigned int k)
        {
          if (k == 2)
            throw InputError("wrong");
          if (k == 5)
            throw ConvergenceError("far");
          return double(k);
        };
      },
      [&](const unsigned int k, const std::function<double()> &outcome)
      {
        try
        {
          EXPECT_EQ(outcome(), k);
          heard.push_back("");
        }
        catch (const InputError &error)
        {
          heard.push_back(std::string("input: ") + error.what());
        }
        catch (const ConvergenceError &error)
        {
          heard.push_back(std::string("convergence: ") + error.what());
        }
      },
      MPI_COMM_WORLD);
  EXPECT_EQ(heard,
            (std::vector<std::string>{"", "", "input: wrong", "", "", "convergence: far", "", "", ""}));
}

TEST(SharedCasesMpi, WhatIsNotCaughtEndsTheSweep)
{
  unsigned int n_arrived = 0;
  const auto run = [&]
  {
    share_cases<double>(
        6, 1,
        []() -> std::function<double(unsigned int)>
        {
          return [](const unsigned int k)
          {
            if (k == 3)
              throw ConvergenceError("far");
            return 0.;
          };
        },
        [&](const unsigned int, const std::function<double()> &outcome)
        {
          outcome();
          ++n_arrived;
        },
        MPI_COMM_WORLD);
  };
  EXPECT_THROW(run(), ConvergenceError);
  EXPECT_EQ(n_arrived, 3u);
}
