/// Error against processor time of every contact solver over the stored problems and over steps of few points.
///
///   stored_problems_benchmark [repetitions, default 5] [half-space | elements | road | few, default all] [quick]
///
/// Lines of a set of problems, a solver, its tolerance, the largest relative error of the forces, and the processor seconds
/// of all problems of the set, cold, one number per repetition. Truth: the fixed point to 1e-12, for the fixed point
/// itself Newton's method to 1e-12; the two share no code but the residual.
///
/// half-space, elements: stored problems on their points near contact. road: 30 points without friction; few: four
/// points with friction; each of 4000 steps from the solution of the step before, whose gaps and slips swing.

#include "../unit/random_contact.h"
#include "../unit/stored_problems.h"

#include <vibrocontact/contact/contact_solvers.h>
#include <vibrocontact/contact/problem_file.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>

using namespace stored_problems;

namespace
{
  /// Problems that a solver gets one after the other.
  struct ProblemSet
  {
    std::string name;
    std::vector<ContactProblem> problems;
    /// whether each begins from the solution of the one before
    bool is_march = false;
  };

  ProblemSet half_space(const bool quick)
  {
    ProblemSet set{"half-space", {}};
    for (const Description &d : descriptions())
    {
      const ContactProblem whole = build(d);
      const auto points = points_near_contact(whole, create_contact_solver({})->solved(whole));
      if (points.size() < 300)
        set.problems.push_back(restrict_to_points(whole, points));
      if (quick && set.problems.size() == 4)
        break;
    }
    return set;
  }

  ProblemSet elements(const bool quick)
  {
    ProblemSet set{"elements", {}};
    for (const char *name : {"blocks_lateral", "blocks_spin", "wheel_on_rail_lateral", "wheel_on_rail_spin"})
      if (!quick || set.problems.size() < 2)
        set.problems.push_back(read_contact_problem(folder() + name + ".h5"));
    return set;
  }

  ProblemSet steps(const std::string &name, const unsigned int n_points, const unsigned int n_components)
  {
    ProblemSet set{name, {}, true};
    ContactProblem problem =
        random_contact(n_points, n_components, 0.3, create_normal_law("signorini"), n_points);
    const DenseVector mean = problem.b;
    for (unsigned int k = 0; k < 4000; ++k)
    {
      for (unsigned int row = 0; row < mean.size(); ++row)
        problem.b[row] = mean[row] + 5e-5 * std::sin(0.02 * k + 1.7 * row);
      set.problems.push_back(problem);
    }
    return set;
  }

  std::vector<DenseVector> forces(const ProblemSet &set, const std::string &method, const double tolerance)
  {
    ContactSolverParameters parameters;
    parameters.method = method;
    parameters.tolerance = tolerance;
    // the fixed point stops by it; as far from the tolerance as their defaults are
    parameters.force_change = 1e-3 * tolerance;
    const auto solver = create_contact_solver(parameters);
    std::vector<DenseVector> result;
    ContactSolution state;
    for (const ContactProblem &problem : set.problems)
    {
      if (!set.is_march)
        state = {};
      solver->solve(problem, state);
      result.push_back(state.R);
    }
    return result;
  }

  void measure(const ProblemSet &set, const unsigned int repetitions, const bool quick)
  {
    const auto by_fixed_point = forces(set, "fixed point", 1e-12),
               by_newton = forces(set, "semi-smooth newton", 1e-12);
    struct Measured
    {
      std::string method;
      double tolerance;
      std::vector<DenseVector> found;
      std::vector<double> seconds;
    };
    std::vector<Measured> all;
    for (const ContactSolverEntry &row : contact_solvers())
      if (!row.takes || row.takes(set.problems[0]))
        for (const double tolerance :
             quick ? std::vector<double>{1e-5, 1e-10} : std::vector<double>{1e-2, 1e-3, 1e-5, 1e-7, 1e-10})
          all.push_back({row.name, tolerance, {}, {}});
    // in turns, so that what disturbs the machine for a while disturbs all of them
    for (unsigned int k = 0; k < repetitions; ++k)
      for (Measured &one : all)
      {
        const std::clock_t begin = std::clock();
        one.found = forces(set, one.method, one.tolerance);
        one.seconds.push_back(double(std::clock() - begin) / CLOCKS_PER_SEC);
      }
    for (const Measured &one : all)
    {
      double error = 0;
      const auto &truth = one.method == "fixed point" ? by_newton : by_fixed_point;
      for (unsigned int k = 0; k < one.found.size(); ++k)
        if (truth[k].l2_norm() > 0)
          error = std::max(error, difference(one.found[k], truth[k]));
      std::printf("%s,%s,%g,%.3e", set.name.c_str(), one.method.c_str(), one.tolerance, error);
      for (const double seconds : one.seconds)
        std::printf(",%.6e", seconds);
      std::printf("\n");
    }
    std::fflush(stdout);
  }
} // namespace

int main(int argc, char **argv)
{
  const unsigned int repetitions = argc > 1 ? std::atoi(argv[1]) : 5;
  const std::string only = argc > 2 ? argv[2] : "";
  const bool quick = argc > 3 && std::string(argv[3]) == "quick";
  const auto wanted = [&](const char *name) { return only.empty() || only == name; };
  if (wanted("half-space"))
    measure(half_space(quick), repetitions, quick);
  if (wanted("elements"))
    measure(elements(quick), repetitions, quick);
  if (wanted("road"))
    measure(steps("road", 30, 1), repetitions, quick);
  if (wanted("few"))
    measure(steps("few", 4, 3), repetitions, quick);
}
