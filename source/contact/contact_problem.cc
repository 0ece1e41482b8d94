#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/contact/contact_problem.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace vibrocontact
{
  double ContactProblem::resultant(const DenseVector &R) const
  {
    const unsigned int n = n_points();
    double sum = 0;
    for (unsigned int i = 0; i < n && to_force.size() == 0; ++i)
      sum += R[i];
    for (unsigned int row = 0; row < to_force.size(); ++row)
      sum += to_force[row] * R[row];
    return sum;
  }

  void ContactProblem::move(DenseVector &y, const double change) const
  {
    const unsigned int n = n_points();
    for (unsigned int i = 0; i < n && by_approach.size() == 0; ++i)
      y[i] -= change;
    for (unsigned int row = 0; row < by_approach.size(); ++row)
      y[row] -= change * by_approach[row];
  }

  void check_finite(const ContactProblem &problem)
  {
    const auto finite = [](const double x) { return std::isfinite(x); };
    if (!std::all_of(problem.b.begin(), problem.b.end(), finite) ||
        !std::all_of(problem.mu.begin(), problem.mu.end(), finite) || !finite(problem.normal_force) ||
        !finite(problem.approach))
      throw ConvergenceError(
          "The contact problem '" + problem.title +
          "' holds numbers that are not finite; check the loads, creepages and bodies that "
          "it is made of.");
  }

  bool ContactSolution::is_finite() const
  {
    return std::isfinite(approach) &&
           std::all_of(R.begin(), R.end(), [](const double force) { return std::isfinite(force); });
  }

  namespace
  {
    // The law holds for any rho. Without a tangential diagonal forces do not change the slip (steady sliding
    // at rolling speed 0, a bar on a stop): rho then takes the trial force of sliding points well out of the
    // disc.
    double tangential_rho(const ContactProblem &problem, const double factor)
    {
      const double diagonal = problem.A->mean_diagonal(1) + problem.A->mean_diagonal(2);
      if (diagonal != 0)
        return 2 * factor / diagonal;
      double slip = 0, approach = std::abs(problem.approach);
      const unsigned int n = problem.n_points();
      for (unsigned int i = 0; i < n; ++i)
      {
        slip = std::max(slip, std::hypot(problem.b[n + i], problem.b[2 * n + i]));
        approach = std::max(approach, std::abs(problem.b[i] - problem.approach));
      }
      const double force = std::max(problem.normal_force, approach / problem.A->mean_diagonal(0));
      return slip > 0 && force > 0 ? 1e3 * force / slip : 1.;
    }
  } // namespace

  ContactResidual::ContactResidual(const ContactProblem &problem, const double tangential_factor)
      : rho_normal(1 / problem.A->mean_diagonal(0)),
        rho_tangential(tangential_rho(problem, tangential_factor)), problem(problem)
  {
    if (!(rho_normal > 0 && rho_tangential > 0 && std::isfinite(rho_normal) && std::isfinite(rho_tangential)))
    {
      std::ostringstream text;
      text << "The contact problem cannot be solved in double precision: a compliance of "
           << problem.A->mean_diagonal(0) << " m/N on the diagonal, augmentation parameters " << rho_normal
           << " N/m and " << rho_tangential
           << " N s/m; material, load, creepages or spacing of the contact are out of all proportion.";
      throw ConvergenceError(text.str());
    }
  }

  double ContactResidual::evaluate(const DenseVector &R, const DenseVector &y, DenseVector &projected,
                                   std::vector<ContactStatus> &status) const
  {
    const unsigned int n = problem.n_points();
    projected.reinit(3 * n, true);
    status.resize(n);
    double difference = 0, scale = 0, normal = 0;
    for (unsigned int i = 0; i < n; ++i)
    {
      const double force = problem.normal_law[i].project(R[i], y[i], rho_normal).force;
      const DiscProjection friction = project_on_disc(
          {{R[n + i] - rho_tangential * y[n + i], R[2 * n + i] - rho_tangential * y[2 * n + i]}},
          problem.mu[i] * force);
      projected[i] = force;
      projected[n + i] = friction.force[0];
      projected[2 * n + i] = friction.force[1];
      status[i] =
          force > 0 ? (friction.sticks ? ContactStatus::stick : ContactStatus::slip) : ContactStatus::open;
      for (unsigned int c = 0; c < 3; ++c)
        difference += std::pow(R[c * n + i] - projected[c * n + i], 2);
      scale += std::pow(problem.mu[i] * force, 2);
      normal += force * force;
    }
    if (scale == 0)
      scale = normal;
    if (scale == 0)
      scale = difference; // forces that all have to go: as wrong as can be
    return difference == 0 ? 0 : std::sqrt(difference / scale);
  }

  std::vector<unsigned int> loaded_points(const DenseVector &R)
  {
    const unsigned int n = R.size() / 3;
    std::vector<unsigned int> points;
    for (unsigned int i = 0; i < n; ++i)
      if (R[i] != 0 || R[n + i] != 0 || R[2 * n + i] != 0)
        points.push_back(i);
    return points;
  }

  void contact_response(const ContactProblem &problem, const DenseVector &R, const double approach,
                        DenseVector &y)
  {
    problem.A->vmult(y, R, loaded_points(R));
    y += problem.b;
    problem.move(y, approach);
  }
} // namespace vibrocontact
