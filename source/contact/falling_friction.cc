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
        "Friction at rest over Friction coefficient; above 1 friction falls with the slip speed, below 1 it "
        "rises (friction modifiers). Units: none.",
        Double(1e-3, 10));
    prm.add_parameter("Stribeck velocity", velocity,
                      "Slip speed over which friction goes 63 % of its way. Units: m/s.", Double(1e-9, 1e3));
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
    // one solution however steep it is, about which the loop would jump: each point goes by secants instead
    const bool rises = falling.ratio < 1;
    std::vector<double> share(problem.mu.size(), 1.), missing(problem.mu.size(), 0.), step(missing);
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
        const double before = missing[i];
        missing[i] = mu - problem.mu[i];
        if (rises && round > 0 && missing[i] != before)
          share[i] = std::clamp(step[i] / (before - missing[i]), 1e-3, 1.);
        step[i] = share[i] * missing[i];
        problem.mu[i] = rises ? problem.mu[i] + step[i] : mu;
      }
      if (change <= 1e-9 * mu_k)
        return solution;
    }
    solution.converged = false;
    return solution;
  }
} // namespace vibrocontact
