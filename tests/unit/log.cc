// The log keeps what was said before the file exists, and the Mpi suite runs on one and on two ranks.
#include <vibrocontact/base/log.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <sstream>

using namespace vibrocontact;

TEST(Log, LinesBeforeTheFileAreKept)
{
  Log log;
  log.set_screen(false);
  log.block("Wheel");
  log.value("mass", 314.86, "kg");
  log.open_file("log_test.txt");
  log.line("later");
  log.open_file("");
  std::ifstream file("log_test.txt");
  std::stringstream text;
  text << file.rdbuf();
  std::remove("log_test.txt");
  EXPECT_NE(text.str().find("314.86 kg"), std::string::npos);
  EXPECT_LT(text.str().find("Wheel"), text.str().find("later"));
}

// What a part says stands under its own heading, what comes after it under the heading from before again; a block that
// says nothing has no heading.
TEST(Log, EachLineStandsUnderItsHeading)
{
  run_log().set_screen(false);
  run_log().open_file("log_part_test.txt");
  run_log().block("Modes");
  {
    const Log::Part part("Reduction");
    const Log::Part inner("Cache");
    run_log().line("found");
  }
  run_log().line("101 modes");
  run_log().block("Silent");
  run_log().block("Rolling");
  run_log().line("converged");
  run_log().open_file("");
  std::ifstream file("log_part_test.txt");
  std::stringstream text;
  text << file.rdbuf();
  std::remove("log_part_test.txt");
  run_log().set_screen(true);
  const std::string all = text.str();
  EXPECT_NE(all.find("\nCache\n  found\n\nModes\n  101 modes\n\nRolling\n  converged\n"), std::string::npos)
      << all;
  EXPECT_EQ(all.find("Reduction"), std::string::npos) << all;
}

TEST(Log, TimeText)
{
  EXPECT_EQ(time_text(0.0341), "0.0341 s");
  EXPECT_EQ(time_text(245.2), "4 min 05 s");
}

TEST(LogMpi, OnlyTheFirstRankWrites)
{
  const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  const std::string name = "log_mpi_test_" + std::to_string(rank) + ".txt";
  Log log;
  log.set_screen(false);
  log.open_file(name);
  log.line("said");
  log.open_file("");
  EXPECT_EQ(std::ifstream(name).good(), rank == 0);
  std::remove(name.c_str());
}
