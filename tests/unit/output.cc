// Tables, results.json and command line follow the documented interface.
#include <vibrocontact/base/atomic_file.h>
#include <vibrocontact/base/blas.h>
#include <vibrocontact/base/command_line.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/folder_lock.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/base/table.h>
#include <vibrocontact/output/run_record.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>

using namespace vibrocontact;

namespace
{
  CommandLine read(std::vector<const char *> words)
  {
    words.insert(words.begin(), "vibrocontact");
    return read_command_line(words.size(), words.data());
  }
} // namespace

TEST(NumberText, PercentagesAboveAHundredHaveNoExponent)
{
  EXPECT_EQ(percent_text(0.00123), "0.12 %");
  EXPECT_EQ(percent_text(0.994), "99 %");
  EXPECT_EQ(percent_text(0.996), "100 %");
  EXPECT_EQ(percent_text(-1.34), "-134 %");
  EXPECT_EQ(percent_text(1e5), "1e+07 %");
}

TEST(Table, NumbersKeepSeventeenDigitsAndLabelsTheirCommas)
{
  Table table({"x_m", "status", "label"}, {"purpose"});
  table.add_row({0.1 + 0.2, 1., "axial(0,2)#2"});
  EXPECT_EQ(table.text(), "# purpose\nx_m,status,label\n0.30000000000000004,1,axial(0;2)/2\n");
  EXPECT_EQ(table.n_rows(), 1u);
}

TEST(Table, RefusesNumbersThatAreNotFinite)
{
  Table table({"x_m"}, {});
  EXPECT_THROW(table.add_row({std::nan("")}), ConvergenceError);
  EXPECT_THROW(table.add_row({1., 2.}), dealii::ExceptionBase);
  EXPECT_EQ(table.n_rows(), 0u);
}

TEST(Table, FilesAppearWhole)
{
  Table table({"x_m"}, {});
  table.add_row({1.5});
  table.write("table_test/deep/table.csv");
  std::ifstream file("table_test/deep/table.csv");
  std::string header, row;
  std::getline(file, header);
  std::getline(file, row);
  EXPECT_EQ(row, "1.5");
  unsigned int n_files = 0;
  for ([[maybe_unused]] const auto &entry : std::filesystem::directory_iterator("table_test/deep"))
    ++n_files;
  EXPECT_EQ(n_files, 1u) << "a temporary file stays";
  std::filesystem::remove_all("table_test");
  EXPECT_THROW(table.write("/proc/nowhere/table.csv"), OutputError);
}

TEST(AtomicFile, AMissingSourceIsNoMissingPermission)
{
  try
  {
    copy_file("no such file", "copy_test");
    FAIL() << "copied";
  }
  catch (const OutputError &error)
  {
    EXPECT_NE(std::string(error.what()).find("\"no such file\""), std::string::npos) << error.what();
    EXPECT_EQ(std::string(error.what()).find("permission"), std::string::npos) << error.what();
  }
  EXPECT_FALSE(std::filesystem::exists("copy_test"));
}

TEST(Results, NamesOfTheInterface)
{
  Results results;
  EXPECT_EQ(nlohmann::json::parse(results_text(results, 0))["status"], "not converged");
  EXPECT_EQ(nlohmann::json::parse(results_text(results, 0))["complete"], false);
  results.complete = true;
  results.analyses["modes"]["wheel"]["frequencies_Hz"] = {136.3, 334.1};
  const auto json = nlohmann::json::parse(results_text(results, 1.5));
  EXPECT_EQ(json["status"], "converged");
  EXPECT_EQ(json["wall_s"], 1.5);
  for (const char *name : {"version", "commit", "dealii", "ranks"})
    EXPECT_TRUE(json["program"].contains(name)) << name;
  EXPECT_EQ(json["analyses"]["modes"]["wheel"]["frequencies_Hz"][1], 334.1);
  results.failures.push_back({"modes", "no"});
  EXPECT_EQ(nlohmann::json::parse(results_text(results, 0))["status"], "not converged");
  results.analyses["wrong"] = {1., std::numeric_limits<double>::infinity()};
  EXPECT_THROW(results_text(results, 0), ConvergenceError);
}

TEST(Results, AResumedRunForgetsWhatWasSaidOfWhatItDoesAgain)
{
  Results results;
  results.finished = {"stability"};
  results.failures = {{"stability", "a case"}, {"transient", "a step"}, {"", "the run"}};
  results.warnings = {{"transient", "few steps"}, {"stability", "few modes"}};
  const std::string text = results_text(results, 0);
  EXPECT_EQ(nlohmann::json::parse(text)["messages"].size(), 5u);
  EXPECT_EQ(nlohmann::json::parse(text)["warnings"][1]["analysis"], "stability");
  Results later = results_of_text(text);
  ASSERT_EQ(later.failures.size(), 1u);
  EXPECT_EQ(later.failures[0].analysis, "stability");
  EXPECT_EQ(later.failures[0].message, "a case");
  ASSERT_EQ(later.warnings.size(), 1u);
  EXPECT_EQ(later.warnings[0].message, "few modes");
  later.forget("stability");
  EXPECT_TRUE(later.converged() && later.warnings.empty() && later.finished.empty());
  results.failures.erase(results.failures.begin());
  EXPECT_TRUE(results_of_text(results_text(results, 0)).converged());
}

TEST(Results, ThoseOfAnEarlierRunAreTakenOnlyAsTheyWereWritten)
{
  Results results;
  results.finished = {"modes"};
  results.analyses["modes"]["wheel"]["frequencies_Hz"] = {136.3, 1. / 3, -0., 1e300};
  const std::string text = results_text(results, 1. / 7);
  EXPECT_EQ(results_of_text(text).analyses, results.analyses);
  EXPECT_EQ(results_of_text(nlohmann::ordered_json::parse(text).dump()).analyses, results.analyses);
  const std::size_t place = text.find("136.3");
  ASSERT_NE(place, std::string::npos);
  for (const char digit : {'2', '7'})
  {
    std::string changed = text;
    changed[place + 1] = digit;
    EXPECT_THROW(results_of_text(changed), InputError) << digit;
  }
}

TEST(RunRecordMpi, TheFolderSaysWhatItIsFromTheBeginning)
{
  const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  const std::string folder = "run_record_test";
  const auto status = [&]
  {
    if (rank > 0)
      return std::string();
    std::ifstream file(folder + "/results.json");
    return nlohmann::json::parse(file)["status"].get<std::string>();
  };
  auto lock = std::make_unique<FolderLock>(folder, "test", true);
  RunRecord record(folder, ParameterFile("case.prm", "# nothing\n"), DeclaredParameters());
  EXPECT_EQ(status(), rank > 0 ? "" : "not converged");
  Results results;
  results.complete = true;
  record.save_sometimes(results, 1.);
  EXPECT_EQ(status(), rank > 0 ? "" : "not converged") << "written twice within a second";
  record.save(results, 1.);
  EXPECT_EQ(status(), rank > 0 ? "" : "converged");
  record.discard();
  lock.reset();
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_FALSE(std::filesystem::exists(folder));
  EXPECT_THROW(RunRecord("/proc/nowhere", ParameterFile("case.prm", ""), DeclaredParameters()), InputError);
}

TEST(CommandLine, OptionsOfTheInterface)
{
  const CommandLine line = read({"case.prm", "--set", "Contact/Friction coefficient=0.1", "--set", "Title=x",
                                 "--output", "dir", "--quiet", "--check"});
  EXPECT_EQ(line.file, "case.prm");
  EXPECT_EQ(line.output, "dir");
  ASSERT_EQ(line.overrides.size(), 2u);
  EXPECT_EQ(line.overrides[0], "Contact/Friction coefficient=0.1");
  EXPECT_TRUE(line.quiet && line.check);
  EXPECT_TRUE(read({"--parameters"}).parameters);
  EXPECT_TRUE(read({"--version"}).version);
  EXPECT_TRUE(read({"--help"}).help);
  EXPECT_NE(command_line_help().find("--resume"), std::string::npos);
}

TEST(CommandLine, WrongOnesAreRefused)
{
  EXPECT_THROW(read({}), InputError);
  EXPECT_THROW(read({"a.prm", "b.prm"}), InputError);
  EXPECT_THROW(read({"a.prm", "--set"}), InputError);
  EXPECT_THROW(read({"a.prm", "--outptu", "x"}), InputError);
  EXPECT_TRUE(read({"a.prm", "--resume"}).resume);
  try
  {
    read({"a.prm", "--chekc"});
  }
  catch (const InputError &error)
  {
    EXPECT_NE(std::string(error.what()).find("did you mean \"--check\"?"), std::string::npos) << error.what();
  }
}

TEST(Blas, TakesTheKernelsOfThisProcessor)
{
  for (const char *fallback : {"Prescott", "Barcelona", "Nehalem", "Sandybridge"})
  {
    EXPECT_EQ(better_kernels(fallback, true, true), "SkylakeX");
    EXPECT_EQ(better_kernels(fallback, true, false), "Haswell");
    EXPECT_EQ(better_kernels(fallback, false, false), "");
  }
  for (const char *right : {"Haswell", "Zen", "SkylakeX", "Cooperlake", "Sapphirerapids", "armv8", ""})
    EXPECT_EQ(better_kernels(right, true, true), "") << right;
  // those of this process, unless slow ones were asked for
  const char *asked = std::getenv("OPENBLAS_CORETYPE");
  if (asked == nullptr || better_kernels(asked, true, false).empty())
    EXPECT_EQ(better_kernels(blas_kernels(), __builtin_cpu_supports("avx2"), false), "") << blas_kernels();
}

TEST(Blas, IsJudgedByTheLibraryThatIsLoaded)
{
  EXPECT_TRUE(std::filesystem::exists(loaded_blas())) << loaded_blas();
  const std::string folder = "/usr/lib/x86_64-linux-gnu/";
  EXPECT_TRUE(is_reference_blas(folder + "blas/libblas.so.3.11.0"));
  EXPECT_TRUE(is_reference_blas("/usr/lib64/libblas.so.3"));
  for (const char *other :
       {"openblas-pthread/libblas.so.3", "openblas-serial/libopenblas-r0.3.21.so", "atlas/libblas.so.3",
        "blis-openmp/libblas.so.3", "libmkl_rt.so", "libopenblas.so.0"})
    EXPECT_FALSE(is_reference_blas(folder + other)) << other;
  EXPECT_NE(faster_blas_advice("/nowhere/blas/libblas.so.3").find("install libopenblas0-pthread"),
            std::string::npos);
  std::filesystem::create_directories("blas_test/openblas-serial");
  std::ofstream("blas_test/openblas-serial/libblas.so.3") << "here";
  const std::string advice = faster_blas_advice("blas_test/blas/libblas.so.3");
  EXPECT_NE(advice.find("openblas-serial is installed"), std::string::npos) << advice;
  EXPECT_EQ(advice.find("install lib"), std::string::npos) << advice;
  std::filesystem::remove_all("blas_test");
}
