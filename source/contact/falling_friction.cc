#include <vibrocontact/contact/falling_friction.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  void FallingFriction::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter(
        "Static friction ratio", ratio,
        "Friction at rest over Friction coefficient; above 1 friction falls with the slip speed. "
        "Units: none.",
        Double(1, 10));
    prm.add_parameter("Stribeck velocity", velocity,
                      "Slip speed over which friction falls by 63 %. Units: m/s.", Double(1e-9, 1e3));
  }

  double FallingFriction::factor(const double speed) const
  {
    return 1 + (ratio - 1) * std::exp(-speed / velocity);
  }

  double FallingFriction::slope(const double speed) const
  {
    return -(ratio - 1) / velocity * std::exp(-speed / velocity);
  }

  std::vector<double> slip_speed(const DenseVector &y)
  {
    const unsigned int n = y.size() / 3;
    std::vector<double> speed(n);
    for (unsigned int i = 0; i < n; ++i)
      speed[i] = std::hypot(y[n + i], y[2 * n + i]);
    return speed;
  }

  ContactSolution
  solve_with_falling_friction(ContactProblem &problem, ContactSolver &solver, const ContactSolution &start,
                              const FallingFriction &falling, const double mu_k,
                              const std::function<std::vector<double>(const ContactSolution &)> &speed)
  {
    constexpr unsigned int max_rounds = 100;
    ContactSolution solution = start;
    unsigned int iterations = 0, factorisations = 0, fallbacks = 0;
    for (unsigned int round = 0; round < max_rounds; ++round)
    {
      // the response does not depend on mu
      solution.response_known = start.response_known;
      solution = solver.solve(problem, solution);
      solution.iterations = iterations += solution.iterations;
      solution.factorisations = factorisations += solution.factorisations;
      solution.fallbacks = fallbacks += solution.fallbacks;
      if (!solution.converged)
        return solution;
      const std::vector<double> now = speed(solution);
      double change = 0;
      for (unsigned int i = 0; i < now.size(); ++i)
      {
        const double mu = mu_k * falling.factor(now[i]);
        // what an open point would have matters to nobody
        if (solution.status[i] != ContactStatus::open)
          change = std::max(change, std::abs(mu - problem.mu[i]));
        problem.mu[i] = mu;
      }
      if (change <= 1e-9 * mu_k)
        return solution;
    }
    solution.converged = false;
    return solution;
  }
} // namespace vibrocontact
