/// Stored contact problems, each written to FCLIB's format, read again and solved by every solver.

#include "stored_problems.h"

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/hdf5_file.h>
#include <vibrocontact/contact/contact_solvers.h>
#include <vibrocontact/contact/problem_file.h>

#include <gtest/gtest.h>
#include <hdf5.h>

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <sys/resource.h>
#include <unistd.h>

using namespace stored_problems;

namespace
{
  std::string scratch_file()
  {
    return "contact_problem_" + std::to_string(getpid()) + ".h5";
  }

  unsigned int contact_points(const ContactSolution &s)
  {
    return s.status.size() - std::count(s.status.begin(), s.status.end(), ContactStatus::open);
  }

  /// Solves a problem cold and warm by every solver and compares them; @return Newton's solution
  ContactSolution solve_by_all(const ContactProblem &problem, const ContactSolution &neighbour,
                               const std::string &variant)
  {
    ContactSolution first;
    for (const ContactSolverEntry &entry : contact_solvers())
    {
      if (entry.takes && !entry.takes(problem))
        continue;
      ContactSolverParameters parameters;
      parameters.method = entry.name;
      const ContactSolution cold = create_contact_solver(parameters)->solved(problem);
      EXPECT_TRUE(cold.converged) << entry.name;
      EXPECT_LE(cold.residual, 1e-10) << entry.name;
      const unsigned int points = contact_points(cold);
      const unsigned int stick = std::count(cold.status.begin(), cold.status.end(), ContactStatus::stick);
      std::printf("%s, %s, %s: %u points, %u stick; cold %u iterations, fallbacks %u, residual %.1e, %.1f ms",
                  problem.title.c_str(), variant.c_str(), entry.name.c_str(), points, stick, cold.iterations,
                  cold.fallbacks, cold.residual, cold.seconds * 1e3);
      EXPECT_GE(points, problem.title == "four_hundred_points" ? 400u : 90u);
      if (first.empty())
      {
        first = cold;
        EXPECT_LE(cold.iterations, 20u);
        const ContactSolution warm = create_contact_solver(parameters)->solved(problem, neighbour);
        EXPECT_TRUE(warm.converged);
        EXPECT_LE(warm.iterations, 12u);
        EXPECT_LE(difference(warm.R, cold.R), 1e-8);
        std::printf("; warm %u iterations, %.1f ms\n", warm.iterations, warm.seconds * 1e3);
      }
      else
      {
        std::printf("; forces differ by %.1e\n", difference(cold.R, first.R));
        EXPECT_LE(difference(cold.R, first.R), 1e-8) << entry.name;
      }
    }
    return first;
  }
} // namespace

class HalfSpaceProblem : public testing::TestWithParam<Description>
{
};

TEST_P(HalfSpaceProblem, IsSolvedByEverySolverFromAFile)
{
  const ContactProblem whole = build(GetParam());
  const ContactSolution s = create_contact_solver({})->solved(whole);
  ASSERT_TRUE(s.converged);

  const std::vector<unsigned int> points = points_near_contact(whole, s);
  ContactProblem problem = restrict_to_points(whole, points);
  const ContactProblem slower = restrict_to_points(build(GetParam(), 0.85), points);
  const ContactSolution neighbour = create_contact_solver({})->solved(slower);

  const std::string file = scratch_file();
  ContactSolution solution;
  for (const bool force_given : {true, false})
  {
    if (!force_given)
    {
      problem.normal_force = 0;
      problem.approach = s.approach;
    }
    write_contact_problem(file, problem, solution);
    const ContactProblem read = read_contact_problem(file);
    const ContactSolution stored = read_contact_solution(file, read);
    std::remove(file.c_str());
    EXPECT_EQ(read.title, problem.title);
    EXPECT_EQ(stored.empty(), force_given);
    if (!force_given)
      EXPECT_LE(stored.residual, 1e-9);
    solution = solve_by_all(read, neighbour, force_given ? "force" : "approach");
    EXPECT_NEAR(solution.approach / s.approach, 1, 1e-8);
    for (unsigned int k = 0; k < points.size(); ++k)
      EXPECT_NEAR(solution.R[k], s.R[points[k]], 1e-7 * s.R.linfty_norm());
  }
}

INSTANTIATE_TEST_SUITE_P(Stored, HalfSpaceProblem, testing::ValuesIn(descriptions()),
                         [](const auto &info) { return info.param.at("name"); });

class FiniteElementProblem : public testing::TestWithParam<std::string>
{
};

TEST_P(FiniteElementProblem, IsSolvedByEverySolver)
{
  ContactProblem problem = read_contact_problem(folder() + GetParam());
  ContactProblem slower = problem;
  for (unsigned int row = problem.n_points(); row < problem.b.size(); ++row)
    slower.b[row] *= 0.9;
  const ContactSolution neighbour = create_contact_solver({})->solved(slower);
  const ContactSolution s = solve_by_all(problem, neighbour, problem.force_given() ? "force" : "approach");
  // the other way of loading has the same solution
  if (problem.force_given())
    problem.normal_force = 0;
  else
    for (unsigned int i = 0; i < problem.n_points(); ++i)
      problem.normal_force += s.R[i];
  problem.approach = s.approach;
  const ContactSolution other =
      solve_by_all(problem, neighbour, problem.force_given() ? "force" : "approach");
  EXPECT_LE(difference(other.R, s.R), 1e-8);
}

INSTANTIATE_TEST_SUITE_P(Stored, FiniteElementProblem,
                         testing::Values("blocks_lateral.h5", "blocks_spin.h5", "wheel_on_rail_lateral.h5",
                                         "wheel_on_rail_spin.h5"),
                         [](const auto &info) { return info.param.substr(0, info.param.size() - 3); });

namespace
{
  ContactProblem small_problem()
  {
    DenseMatrix A(6);
    for (unsigned int row = 0; row < 6; ++row)
      for (unsigned int column = 0; column < 6; ++column)
        A(row, column) = row == column ? 2. : 0.1 * row - 0.02 * column;
    ContactProblem problem;
    problem.A = std::make_shared<DenseContactOperator>(std::move(A));
    problem.title = "two points";
    problem.b.reinit(6);
    for (unsigned int row = 0; row < 6; ++row)
      problem.b[row] = -0.5 + 0.1 * row;
    problem.mu = {0.2, 0.4};
    problem.normal_force = 3;
    problem.approach = 0.25;
    return problem;
  }

  /// changes one number of a file, or deletes the set when no value is given
  void tamper(const std::string &file_name, const std::string &path, const double *value)
  {
    const hid_t file = H5Fopen(file_name.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    if (value == nullptr)
      H5Ldelete(file, path.c_str(), H5P_DEFAULT);
    else
    {
      const hid_t set = H5Dopen2(file, path.c_str(), H5P_DEFAULT);
      const hid_t space = H5Dget_space(set);
      std::vector<double> values(H5Sget_simple_extent_npoints(space));
      H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
      values[0] = *value;
      H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
      H5Sclose(space);
      H5Dclose(set);
    }
    H5Fclose(file);
  }

  std::string refusal(const std::string &file_name)
  {
    try
    {
      read_contact_problem(file_name);
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "accepted";
  }
} // namespace

TEST(ContactProblemFile, GivesBackWhatWasWritten)
{
  const std::string file = scratch_file();
  ContactProblem problem = small_problem();
  problem.normal_law = create_normal_law("exponential penalty", {7., 11.});
  for (const bool force_given : {true, false})
  {
    if (!force_given)
      problem.normal_force = 0;
    write_contact_problem(file, problem);
    const ContactProblem read = read_contact_problem(file);
    EXPECT_EQ(read.title, problem.title);
    EXPECT_EQ(read.mu, problem.mu);
    EXPECT_EQ(read.normal_force, problem.normal_force);
    EXPECT_EQ(read.approach, problem.approach);
    EXPECT_EQ(read.normal_law->description().name, "exponential penalty");
    EXPECT_EQ(read.normal_law->description().numbers, (std::vector<double>{7., 11.}));
    DenseMatrix ours, theirs;
    problem.A->extract({0, 1}, ours);
    read.A->extract({0, 1}, theirs);
    for (unsigned int row = 0; row < 6; ++row)
    {
      EXPECT_NEAR(read.b[row], problem.b[row], 1e-15);
      for (unsigned int column = 0; column < 6; ++column)
        EXPECT_EQ(theirs(row, column), ours(row, column));
    }
  }
  std::remove(file.c_str());
}

// Room is made for all rows and columns, however few the entries: 10,000 points ask for 14 GB.
TEST(ContactProblemFile, MoreThanTheMemoryIsRefusedInASentence)
{
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the address sanitizer needs more addresses than the test leaves";
#endif
  const std::string file_name = scratch_file();
  const int rows = 3 * most_points_in_file, n_entries = most_points_in_file;
  {
    Hdf5Writer file(file_name);
    const std::string W = "/fclib_local/W";
    file.write("/fclib_local/spacedim", 3);
    file.write(W + "/m", rows);
    file.write(W + "/n", rows);
    file.write(W + "/nz", n_entries);
    file.write(W + "/nzmax", n_entries);
    std::vector<int> places(n_entries);
    std::iota(places.begin(), places.end(), 0);
    file.write(W + "/p", places);
    file.write(W + "/i", places);
    file.write(W + "/x", std::vector<double>(n_entries, 1e-9));
    file.finish();
  }
  rlimit before, less;
  getrlimit(RLIMIT_AS, &before);
  less = before;
  less.rlim_cur = std::min<rlim_t>(before.rlim_max, rlim_t(10) << 30);
  setrlimit(RLIMIT_AS, &less);
  const std::string refused = refusal(file_name);
  setrlimit(RLIMIT_AS, &before);
  std::remove(file_name.c_str());
  EXPECT_NE(refused.find("of 30000 rows and 30000 columns, needs about 14 GB, but "), std::string::npos)
      << refused;
}

TEST(ContactProblemFile, WrongFilesAreRefusedInASentence)
{
  const std::string file = scratch_file();
  EXPECT_THROW(write_contact_problem("/dev/null/problem.h5", small_problem()), OutputError);
  EXPECT_NE(refusal("/no/such/file.h5").find("missing or no HDF5 file"), std::string::npos);
  {
    std::ofstream(file) << "not HDF5";
    EXPECT_NE(refusal(file).find("missing or no HDF5 file"), std::string::npos);
  }
  const double nan = std::nan(""), negative = -1, seven = 7, zero = 0, many = 1000;
  const struct
  {
    const char *path;
    const double *value;
    const char *message;
  } cases[] = {{"/fclib_local/W/x", &nan, "not a finite number"},
               {"/fclib_local/vectors/q", &nan, "not a finite number"},
               {"/fclib_local/vectors/mu", &negative, "negative friction coefficient"},
               {"/fclib_local/vectors/mu", nullptr, "has no '/fclib_local/vectors/mu'"},
               {"/fclib_local/W", nullptr, "has no '/fclib_local/W/m'"},
               {"/fclib_local/W/m", &seven, "not square"},
               {"/fclib_local/W/i", &seven, "outside its size"},
               {"/fclib_local/W/p", &negative, "pointers"},
               {"/fclib_local/W/nz", &negative, "accepted"},
               {"/fclib_local/W/nz", &many, "more triplets"},
               {"/fclib_local/spacedim", &zero, "not three-dimensional"},
               {"/fclib_local/V/x", &seven, "equality constraints"},
               {"/fclib_local/vectors/s", &zero, "normal force s that is not positive"},
               {"/fclib_local", nullptr, "has no '/fclib_local/spacedim'"}};
  for (const auto &one : cases)
  {
    write_contact_problem(file, small_problem());
    tamper(file, one.path, one.value);
    EXPECT_NE(refusal(file).find(one.message), std::string::npos) << one.path << ": " << refusal(file);
  }
  std::remove(file.c_str());
}
