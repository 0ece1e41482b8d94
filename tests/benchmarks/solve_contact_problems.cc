/// Solves contact problems and writes each with its solution, for comparison with other programs.
///
///   solve_contact_problems FOLDER [FILE ...]   files of doc/contact_problem_file.md; none: all stored problems of tests/contact_problems
///
/// A problem with a given normal force is solved first, then again at the approach found: what is written and timed is that second
/// one, without an equality constraint. One line each: name, points, points in contact, iterations, residual, least processor time
/// of a cold solve in ms. FOLDER/<name>.h5 holds problem and forces.

#include "../unit/stored_problems.h"

#include <vibrocontact/contact/contact_solvers.h>
#include <vibrocontact/contact/problem_file.h>

#include <cstdio>
#include <ctime>
#include <filesystem>

using namespace stored_problems;

namespace
{
  void solve(const std::string &folder, const std::string &name, ContactProblem problem)
  {
    const auto solver = create_contact_solver({});
    ContactSolution solution = solver->solved(problem);
    problem.normal_force = 0;
    problem.approach = solution.approach;
    double least = 1e300, total = 0;
    for (unsigned int k = 0; k < 20 && total < 2000; ++k)
    {
      const std::clock_t begin = std::clock();
      solution = solver->solved(problem);
      const double ms = 1e3 * (std::clock() - begin) / CLOCKS_PER_SEC;
      least = std::min(least, ms);
      total += ms;
    }
    const unsigned int open = std::count(solution.status.begin(), solution.status.end(), ContactStatus::open);
    std::printf("%s,%u,%ld,%u,%.3e,%.4f%s\n", name.c_str(), problem.n_points(),
                long(problem.n_points() - open), solution.iterations, solution.residual, least,
                solution.converged ? "" : ",NOT CONVERGED");
    write_contact_problem(folder + "/" + name + ".h5", problem, solution);
  }

  ContactProblem near_contact(const ContactProblem &whole)
  {
    return restrict_to_points(whole, points_near_contact(whole, create_contact_solver({})->solved(whole)));
  }
} // namespace

int main(int argc, char **argv)
{
  if (argc < 2)
  {
    std::fprintf(stderr, "usage: solve_contact_problems FOLDER [FILE ...]\n");
    return 1;
  }
  std::vector<std::string> files(argv + 2, argv + argc);
  if (files.empty())
  {
    for (const Description &description : descriptions())
      solve(argv[1], description.at("name"), near_contact(build(description)));
    for (const auto &entry : std::filesystem::directory_iterator(folder()))
      if (entry.path().extension() == ".h5")
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
  }
  for (const std::string &file : files)
    solve(argv[1], std::filesystem::path(file).stem(), read_contact_problem(file));
}
