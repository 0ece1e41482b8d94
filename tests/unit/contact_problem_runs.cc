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

// The hub presses the upper of two contacts alone, the lower one has a law of its own: the file holds both.
TEST(ContactProblemFile, OfSeveralContactsIsSolvedAgain)
{
  const std::string folder = "contacts_problem_run_" + std::to_string(getpid()), file = folder + ".prm";
  const auto bar = [](const std::string &name)
  {
    return "subsection " + name + "\nset Type = bar\nsubsection Bar\nset Length = 0.5\nset Section = 1e-4\n" +
           "set Divisions = 8\nend\nsubsection Material\nset Young modulus = 2.1e11\nend\nend\n";
  };
  std::ofstream(file)
      << "set Bodies = post, middle, floor\nset Contacts = upper, lower\n"
      << "set Analyses = quasi-static rolling\n"
      << bar("post") << bar("middle") << "subsection floor\nset Type = rigid\nend\n"
      << "subsection upper\nset Bodies = post, middle\nset Friction coefficient = 0\n"
      << "set Origin on body 2 = 0, 0, 0.25\nend\n"
      << "subsection lower\nset Bodies = middle, floor\nset Friction coefficient = 0\n"
      << "set Normal law = linear spring\nset Penalty amplitude = 4e7\nset Penalty exponent = 1\nend\n"
      << "subsection Contact\nsubsection Solver\nset Tolerance = 1e-13\nend\nend\n"
      << "subsection Rolling\nset Normal force = 1000\nset Speed = 0\nend\n"
      << "subsection Output\nset Contact problems = true\nset Figures = false\n"
      << "set Cache directory = " << folder << "\nend\n";
  ASSERT_EQ(std::system((std::string(PROGRAM_FILE) + " " + file + " --quiet --output " + folder).c_str()), 0);
  const ContactProblem problem = read_contact_problem(folder + "/contact_problems/case_0.h5");
  const ContactSolution stored = read_contact_solution(folder + "/contact_problems/case_0.h5", problem);
  nlohmann::json results;
  std::ifstream(folder + "/results.json") >> results;
  std::filesystem::remove_all(folder);
  std::filesystem::remove(file);
  const auto contacts = results["analyses"]["quasi_static_rolling"]["contacts"];

  ASSERT_EQ(problem.n_points(), 2u);
  EXPECT_TRUE(problem.normal_law[0].is_rigid());
  EXPECT_EQ(problem.normal_law[1].compression(4e7).depth, 1);
  EXPECT_LT(stored.residual, 1e-10);
  for (const ContactSolverEntry &entry : contact_solvers())
  {
    if (entry.takes && !entry.takes(problem))
      continue;
    ContactSolverParameters parameters;
    parameters.method = entry.name;
    const ContactSolution solution = create_contact_solver(parameters)->solved(problem);
    EXPECT_TRUE(solution.converged) << entry.name;
    EXPECT_NEAR(solution.R[0], 1000, 1e-6) << entry.name;
    EXPECT_NEAR(solution.R[1] / contacts["lower"]["cases"][0]["normal_force_N"].get<double>(), 1, 1e-8)
        << entry.name;
  }
  // the middle bar, held at its top, is pushed at half its length and stands on the spring
  const double s = 0.25 / (2.1e11 * 1e-4), by_spring = 1 / 4e7;
  EXPECT_NEAR(stored.R[1], 1000 * s / (2 * s + by_spring), 1e-6);
}
