// A rank that works alone acts for itself and says what it says elsewhere; signals are heard by all who listen; what a
// sweep refuses.
#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/stop_signal.h>
#include <vibrocontact/run/parameter_sweep.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <csignal>
#include <cstdio>
#include <fstream>
#include <iterator>

using namespace vibrocontact;

TEST(SingleRankMpi, EachIsTheFirstAndFailsAlone)
{
  const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD),
                     n = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  unsigned int acted = 0;
  bool thrown = false;
  {
    const SingleRank lone;
    on_first_rank([&] { ++acted; });
    // the others do not even call it
    if (rank == n - 1)
      try
      {
        on_all_ranks([] { throw OutputError("full"); });
      }
      catch (const OutputError &)
      {
        thrown = true;
      }
  }
  EXPECT_EQ(dealii::Utilities::MPI::sum(acted, run_communicator()), n);
  EXPECT_EQ(thrown, rank == n - 1);
}

TEST(LogAside, WhatIsSaidGoesToItsFileAlone)
{
  const std::string name = "log_aside.txt";
  const unsigned int warnings = run_log().n_warnings();
  Progress outer("outer", 2);
  {
    const Log::Aside aside(name, false);
    run_log().block("Case");
    Progress inner("inner", 1);
    run_log().line("inside");
    run_log().warning("doubtful");
  }
  {
    const Log::Aside aside(name, true);
    run_log().line("behind");
  }
  std::ifstream file(name);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  for (const char *part : {"Case", "  inside", "  WARNING: doubtful", "  behind"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
  EXPECT_EQ(run_log().n_warnings(), warnings);
  std::remove(name.c_str());
}

TEST(StopSignals, AllThatListenHear)
{
  const StopSignals outer;
  {
    const StopSignals inner;
    EXPECT_EQ(inner.received(), 0);
    std::raise(SIGTERM);
    EXPECT_EQ(inner.received(), SIGTERM);
  }
  EXPECT_EQ(outer.received(), SIGTERM);
  // one that comes later hears of it as well
  const StopSignals later;
  EXPECT_EQ(later.received(), SIGTERM);
}

TEST(ParameterSweep, RefusesWhatNoCaseComputes)
{
  for (const char *entry : {"Output/Directory", "Transient/Sweep/Values", "Title"})
  {
    ParameterSweep sweep;
    sweep.first.entry = entry;
    sweep.first.list = "1, 2";
    EXPECT_THROW(sweep.check("Transient"), InputError) << entry;
  }
  ParameterSweep sweep;
  sweep.first.entry = "Transient/Theta";
  sweep.first.list = "0.5, 1";
  EXPECT_NO_THROW(sweep.check("Transient"));
}
