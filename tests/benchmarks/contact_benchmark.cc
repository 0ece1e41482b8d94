/// Times of the contact solvers on one quasi-static case: wheel on crown, 66 kN, mu 0.3, lateral creepage 0.2
/// %.
///
///   contact_benchmark [finest spacing in mm, default 0.25] [repetitions, default 15]
///
/// Processor time of this process in milliseconds, minimum and median, so that other work on the machine
/// disturbs little. A cold start is one without a state to start from; a warm one starts from the solution at
/// a creepage of 0.18 %.

#include "../unit/contact_cases.h"
#include "../unit/random_contact.h"

#include <vibrocontact/contact/active_set.h>
#include <vibrocontact/contact/contact_solvers.h>
#include <vibrocontact/contact/few_points.h>
#include <vibrocontact/contact/newton.h>
#include <vibrocontact/contact/problem_file.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <functional>
#include <numeric>

using namespace contact_cases;

namespace
{
  struct Times
  {
    double least, median;
  };

  Times measure(unsigned int repetitions, const std::function<void()> &work)
  {
    std::vector<double> ms;
    double total = 0;
    for (unsigned int k = 0; k < repetitions && total < 30e3; ++k)
    {
      const std::clock_t begin = std::clock();
      work();
      ms.push_back(1e3 * (std::clock() - begin) / CLOCKS_PER_SEC);
      total += ms.back();
    }
    std::sort(ms.begin(), ms.end());
    return {ms.front(), ms[ms.size() / 2]};
  }

  ContactProblem problem_at(const double spacing, const double creepage)
  {
    ContactParameters contact;
    contact.spacing = spacing;
    const CreepScheme &scheme = find_creep_scheme(contact.creep_scheme);
    const ContactInterface interface = wheel_on_crown(contact.grid());
    Creepage creep;
    creep.lateral = creepage;
    ContactProblem problem =
        rolling_problem(rolling_operator(interface.contacts.only(), steel_pair(), scheme, creep.speed),
                        interface, scheme, creep, contact);
    problem.normal_force = 66e3;
    return problem;
  }

  void report(const char *name, const ContactProblem &problem, const ContactSolution &neighbour,
              const std::string &method, const unsigned int repetitions)
  {
    ContactSolverParameters parameters;
    parameters.method = method;
    const auto solver = create_contact_solver(parameters);
    ContactSolution cold, warm;
    const Times c = measure(repetitions, [&] { cold = solver->solved(problem); });
    const Times w = measure(repetitions, [&] { warm = solver->solved(problem, neighbour); });
    std::printf("%-34s cold %9.2f (%9.2f) ms %5u its %3u LU %5u linear its, res %.0e; warm %9.2f (%9.2f) ms "
                "%5u its%s\n",
                name, c.least, c.median, cold.iterations, cold.factorisations, cold.linear_iterations,
                cold.residual, w.least, w.median, warm.iterations,
                cold.converged && warm.converged ? "" : " NOT CONVERGED");
  }
} // namespace

namespace
{
  /// ns of a projection by the generic resolvent and as the member has it, over forces and gaps of a point in contact
  void report_laws(const unsigned int repetitions)
  {
    constexpr unsigned int count = 1000000;
    for (const auto &[name, numbers] : std::vector<std::pair<std::string, std::vector<double>>>{
             {"signorini", {}},
             {"linear spring", {1e8, 50}},
             {"exponential penalty", {1e8, 50}},
             {"spring curve", {0, 0, -1e-6, 1e3, -1e-5, 2e4, -1e-4, 1e6}}})
    {
      const auto law = create_normal_law(name, numbers);
      double sum = 0;
      const auto ns = [&](const auto &project)
      {
        return 1e6 / count *
               measure(repetitions,
                       [&]
                       {
                         for (unsigned int k = 0; k < count; ++k)
                           sum += project(1e3 + k, -1e-7 * (k % 97)).force;
                       })
                   .median;
      };
      const double generic = ns([&](const double N, const double g) { return law->resolvent(N, g, 1e9); }),
                   own = ns([&](const double N, const double g) { return law->project(N, g, 1e9); });
      std::printf("%-20s projection %6.1f ns, generic resolvent %6.1f ns (sum %g)\n", name.c_str(), own,
                  generic, sum);
    }
  }
} // namespace

namespace
{
  /// us of a step of few points by the solvers that take it: gaps and slips swing, so that points open, stick and slip
  void report_few_points(const unsigned int repetitions)
  {
    constexpr unsigned int steps = 2000;
    for (const unsigned int n_components : {1u, 3u})
      for (const unsigned int n : {1u, 2u, 3u, 4u, 8u, 30u})
      {
        ContactProblem problem = random_contact(n, n_components, 0.3, create_normal_law("signorini"), n);
        const DenseVector mean = problem.b;
        std::printf("%2u points of %u components:", n, n_components);
        const auto report = [&](const char *name, ContactSolver &solver)
        {
          ContactSolution state;
          const Times times = measure(repetitions,
                                      [&]
                                      {
                                        for (unsigned int k = 0; k < steps; ++k)
                                        {
                                          for (unsigned int row = 0; row < mean.size(); ++row)
                                            problem.b[row] =
                                                mean[row] + 5e-5 * std::sin(0.02 * k + 1.7 * row);
                                          solver.solve(problem, state);
                                        }
                                      });
          std::printf("  %s %.3f", name, 1e3 * times.median / steps);
        };
        NewtonSolver newton({});
        report("newton", newton);
        FewPointsSolver few;
        if (n <= 8)
          report("few points", few);
        ActiveSetSolver active;
        if (n_components == 1)
          report("active set", active);
        const auto automatic = create_contact_solver({});
        report("automatic", *automatic);
        std::printf(" us per step\n");
      }
  }
} // namespace

int main(int argc, char **argv)
{
  const double finest = argc > 1 ? std::atof(argv[1]) : 0.25;
  const unsigned int repetitions = argc > 2 ? std::atoi(argv[2]) : 15;
  report_laws(repetitions);
  report_few_points(repetitions);
  for (const double mm : {1., 0.5, 0.25, 0.125})
  {
    if (mm < finest)
      break;
    ContactProblem problem = problem_at(mm * 1e-3, 0.002), slower = problem_at(mm * 1e-3, 0.0018);
    const auto newton = create_contact_solver({});
    const ContactSolution s = newton->solved(problem), neighbour = newton->solved(slower);
    std::vector<unsigned int> points;
    for (unsigned int i = 0; i < problem.n_points(); ++i)
      if (s.status[i] != ContactStatus::open)
        points.push_back(i);
    const unsigned int m = points.size();
    std::printf("%g mm: %u of %u points in contact; least (median) processor time\n", mm, m,
                problem.n_points());
    const Times influence = measure(repetitions, [&] { problem_at(mm * 1e-3, 0.002); });
    std::printf("%-34s      %9.2f (%9.2f) ms\n", "influence numbers", influence.least, influence.median);
    report("newton, half-space operator", problem, neighbour, "semi-smooth newton", repetitions);
    if (mm > 0.4 || (mm > 0.2 && repetitions == 1))
      report("fixed point, half-space operator", problem, neighbour, "fixed point", mm > 0.4 ? 3 : 1);

    // what the time goes into
    const Times start = measure(repetitions,
                                [&]
                                {
                                  ContactSolution rough;
                                  frictionless_start(problem, 1e-3, rough);
                                });
    DenseVector y;
    const Times product = measure(repetitions, [&] { problem.A->vmult(y, s.R, points); });
    const Times among = measure(repetitions, [&] { problem.A->vmult_among(y, s.R, points); });
    std::printf("  frictionless start %.2f, product %.3f, product among the contact points %.3f ms\n",
                start.least, product.least, among.least);
    if (mm > 0.4 || (mm > 0.2 && repetitions == 1))
    {
      DenseMatrix A;
      const Times extract = measure(repetitions, [&] { problem.A->extract(points, A); });
      const Times lu = measure(repetitions,
                               [&]
                               {
                                 DenseMatrix copy = A;
                                 copy.compute_lu_factorization();
                               });
      std::printf("  matrix of %u rows: extraction %.2f, LU %.2f ms (%.1f Gflop/s)\n", 3 * m, extract.least,
                  lu.least, 2. / 3 * std::pow(3. * m, 3) / lu.least * 1e-6);
      std::vector<unsigned int> all(problem.n_points());
      std::iota(all.begin(), all.end(), 0);
      if (mm > 0.4)
      {
        const ContactProblem dense = restrict_to_points(problem, all);
        report("newton, dense operator", dense, neighbour, "semi-smooth newton", repetitions);
      }
    }
  }
}
