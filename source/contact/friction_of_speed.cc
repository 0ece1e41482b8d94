#include <vibrocontact/contact/friction_of_speed.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  std::vector<double> slip_speed(const ContactSolution &solution)
  {
    const unsigned int n = solution.y.size() / 3;
    std::vector<double> speed(n);
    for (unsigned int i = 0; i < n; ++i)
      speed[i] = std::hypot(solution.y[n + i], solution.y[2 * n + i]);
    return speed;
  }

  SpeedDependence speed_dependence(const NewtonJacobian::Row &row, const double mu, const double normal_force,
                                   const FrictionLaw &law, const Vector2 &slip)
  {
    const double speed = std::hypot(slip[0], slip[1]);
    SpeedDependence result = {};
    if (!(speed > 0 && mu > 0))
      return result;
    const double slope = law.coefficient(speed).slope;
    for (unsigned int d = 0; d < 2; ++d)
    {
      result.direction[d] = slip[d] / speed;
      result.force[d] = row.by_radius[d] / mu * normal_force * slope;
    }
    return result;
  }

  void solve_with_friction_of_speed(ContactProblem &problem, ContactSolver &solver, ContactSolution &solution,
                                    const std::function<std::vector<double>(const ContactSolution &)> &speed)
  {
    if (!problem.friction_law || !problem.friction_law.any(&FrictionLaw::depends_on_speed))
      return solver.solve(problem, solution);
    constexpr unsigned int max_rounds = 100;
    const bool response_known = solution.response_known;
    SolverCost cost;
    std::vector<double> share(problem.mu.size(), 1.), missing(problem.mu.size(), 0.), step(missing);
    for (unsigned int round = 0; round < max_rounds; ++round)
    {
      // the response does not depend on mu
      solution.response_known = response_known;
      solver.solve(problem, solution);
      solution.cost() = cost += solution.cost();
      if (!solution.converged)
        return;
      const std::vector<double> now = speed(solution);
      double change = 0, largest = 0;
      for (unsigned int i = 0; i < now.size(); ++i)
      {
        const double mu =
            problem.friction_law[i].coefficient(now[i], solution.status[i] == ContactStatus::stick);
        largest = std::max(largest, mu);
        // what an open point would have matters to nobody
        if (solution.status[i] != ContactStatus::open)
          change = std::max(change, std::abs(mu - problem.mu[i]));
        const double before = missing[i];
        missing[i] = mu - problem.mu[i];
        // only shorter steps than the whole one: longer ones would not be needed
        if (round > 0 && missing[i] != before)
        {
          const double secant = step[i] / (before - missing[i]);
          share[i] = secant > 0 ? std::clamp(secant, 1e-3, 1.) : 1.;
        }
        step[i] = share[i] * missing[i];
        problem.mu[i] += step[i];
      }
      if (change <= 1e-9 * largest)
        return;
    }
    solution.converged = false;
  }
} // namespace vibrocontact
