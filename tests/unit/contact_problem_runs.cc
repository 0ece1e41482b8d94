// A contact problem that one run of the program has written is read and solved again by another program,
// which finds the same forces; the file carries all that determines them.

#include <vibrocontact/contact/contact_solvers.h>
#include <vibrocontact/contact/problem_file.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <unistd.h>

using namespace vibrocontact;

TEST(ContactProblemFile, OfARunIsSolvedAgain)
{
  const std::string folder = "contact_problem_run_" + std::to_string(getpid());
  const std::string command =
      std::string(PROGRAM_FILE) + " " + TESTS_DIRECTORY +
      "/../parameter_files/examples/half_space_rolling.prm --quiet --output " + folder +
      " --set 'Output/Contact problems=true' --set Output/Figures=false --set Rolling/Grids=one";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const ContactProblem problem = read_contact_problem(folder + "/contact_problems/case_0.h5");
  nlohmann::json results;
  std::ifstream(folder + "/results.json") >> results;
  std::filesystem::remove_all(folder);
  const auto run = results["analyses"]["quasi_static_rolling"]["cases"][0];

  for (const ContactSolverEntry &entry : contact_solvers())
  {
    if (entry.takes && !entry.takes(problem))
      continue;
    ContactSolverParameters parameters;
    parameters.method = entry.name;
    const ContactSolution solution = create_contact_solver(parameters)->solved(problem);
    EXPECT_TRUE(solution.converged) << entry.name;
    double force[3] = {0, 0, 0};
    for (unsigned int component = 0; component < 3; ++component)
      for (unsigned int i = 0; i < problem.n_points(); ++i)
        force[component] += solution.R[component * problem.n_points() + i];
    EXPECT_NEAR(force[0] / run["normal_force_N"].get<double>(), 1, 1e-8) << entry.name;
    EXPECT_NEAR(force[1], run["tangential_force_N"][0].get<double>(), 1e-8 * force[0]) << entry.name;
    EXPECT_NEAR(force[2], run["tangential_force_N"][1].get<double>(), 1e-8 * force[0]) << entry.name;
    EXPECT_NEAR(solution.approach / run["approach_m"].get<double>(), 1, 1e-8) << entry.name;
  }
}

// Two contacts with a law and a friction each; then with a hub that presses one of them alone.
TEST(ContactProblemFile, OfSeveralContactsIsSolvedAgain)
{
  const std::string folder = "contacts_problem_run_" + std::to_string(getpid()), file = folder + "_again.h5";
  const std::string command = std::string(PROGRAM_FILE) + " " + TESTS_DIRECTORY +
                              "/../parameter_files/examples/several_contacts.prm --quiet --output " + folder +
                              " --set 'Output/Contact problems=true' --set Output/Figures=false" +
                              " --set 'right/Normal law=linear spring' --set 'right/Penalty amplitude=2e7'" +
                              " --set 'right/Penalty exponent=1' --set 'Output/Cache directory=" + folder +
                              "'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  ContactProblem problem = read_contact_problem(folder + "/contact_problems/case_0.h5");
  nlohmann::json results;
  std::ifstream(folder + "/results.json") >> results;
  std::filesystem::remove_all(folder);
  const auto run = results["analyses"]["quasi_static_rolling"]["contacts"];
  const unsigned int n = problem.n_points(), n_left = n / 2;
  EXPECT_TRUE(problem.normal_law[n_left - 1].is_rigid());
  EXPECT_EQ(problem.normal_law[n_left].compression(2e7).depth, 1);
  EXPECT_EQ(problem.mu.front(), 0.1);
  EXPECT_EQ(problem.mu.back(), 0.4);
  const auto solved = [](const ContactProblem &one, const std::string &method)
  {
    ContactSolverParameters parameters;
    parameters.method = method;
    parameters.tolerance = 1e-12;
    return create_contact_solver(parameters)->solved(one);
  };
  const auto sum = [&](const DenseVector &R, const unsigned int component, const bool of_left)
  {
    const double *const first = R.begin() + component * n + (of_left ? 0 : n_left);
    return std::accumulate(first, first + n_left, 0.);
  };
  for (const ContactSolverEntry &entry : contact_solvers())
  {
    if (entry.takes && !entry.takes(problem))
      continue;
    const ContactSolution solution = solved(problem, entry.name);
    EXPECT_TRUE(solution.converged) << entry.name;
    for (const bool of_left : {true, false})
    {
      const auto one = run[of_left ? "left" : "right"]["cases"][0];
      EXPECT_NEAR(sum(solution.R, 0, of_left) / one["normal_force_N"].get<double>(), 1, 1e-7) << entry.name;
      EXPECT_NEAR(sum(solution.R, 2, of_left) / one["tangential_force_N"][1].get<double>(), 1, 1e-7)
          << entry.name;
    }
  }

  for (DenseVector *const rows : {&problem.by_approach, &problem.to_force})
  {
    rows->reinit(3 * n);
    for (unsigned int i = 0; i < n_left; ++i)
      (*rows)[i] = 1;
  }
  for (const double force : {2000., 0.})
  {
    problem.normal_force = force;
    problem.approach = 1e-5;
    write_contact_problem(file, problem);
    const ContactProblem again = read_contact_problem(file);
    const ContactSolution one = solved(problem, "automatic"), two = solved(again, "automatic");
    EXPECT_TRUE(one.converged);
    if (force > 0)
      EXPECT_NEAR(sum(one.R, 0, true) / force, 1, 1e-9);
    for (unsigned int row = 0; row < 3 * n; ++row)
      EXPECT_NEAR(two.R[row], one.R[row], 1e-9 * 2000) << row;
    EXPECT_NEAR(two.approach / one.approach, 1, 1e-9);
  }
  std::filesystem::remove(file);
}
