// A contact problem that one run of the program has written is read and solved again by another program,
// which finds the same forces; the file carries all that determines them.

#include <vibrocontact/contact/contact_solvers.h>
#include <vibrocontact/contact/problem_file.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>

using namespace vibrocontact;

TEST(ContactProblemFile, OfARunIsSolvedAgain)
{
  const std::string folder = "contact_problem_run_" + std::to_string(getpid());
  const std::string command = std::string(PROGRAM_FILE) + " " + TESTS_DIRECTORY +
                              "/../parameter_files/examples/half_space_rolling.prm --quiet --output " +
                              folder + " --set 'Output/Contact problems=true' --set Output/Figures=false";
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
