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
      const unsigned int n_tangential = problem.n_components() - 1;
      double diagonal = 0;
      for (unsigned int c = 1; c <= n_tangential; ++c)
        diagonal += problem.A->mean_diagonal(c);
      if (diagonal != 0)
        return n_tangential * factor / diagonal;
      if (n_tangential == 0)
        return 1;
      double slip = 0, approach = std::abs(problem.approach);
      const unsigned int n = problem.n_points();
      for (unsigned int i = 0; i < n; ++i)
      {
        const auto b = at_point(problem.b, n, n_tangential + 1, i);
        slip = std::max(slip, std::hypot(b[1], b[2]));
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
    const unsigned int n_tangential = problem.n_components() - 1;
    rho_of_points.reserve(problem.n_points());
    for (unsigned int i = 0; i < problem.n_points(); ++i)
    {
      const double normal = problem.A->diagonal(0, i);
      double tangential = 0;
      for (unsigned int c = 1; c <= n_tangential; ++c)
        tangential += problem.A->diagonal(c, i);
      rho_of_points.push_back(
          {normal > 0 ? 1 / normal : rho_normal,
           tangential > 0 ? n_tangential * tangential_factor / tangential : rho_tangential});
    }
  }

  double ContactResidual::evaluate(const DenseVector &R, const DenseVector &y, DenseVector &projected,
                                   std::vector<ContactStatus> &status) const
  {
    const unsigned int n = problem.n_points(), n_components = problem.n_components();
    if (projected.size() != n_components * n)
      projected.reinit(n_components * n);
    status.resize(n);
    double normal_defect = 0, tangential_defect = 0, normal = 0, friction_limit = 0;
    for (unsigned int i = 0; i < n; ++i)
    {
      const double force = problem.normal_law[i].project(R[i], y[i], rho_normal_of(i)).force;
      projected[i] = force;
      status[i] = force > 0 ? ContactStatus::stick : ContactStatus::open;
      normal_defect += std::pow(R[i] - force, 2);
      normal += force * force;
      if (n_components == 1)
        continue;
      const auto own = at_point(R, n, n_components, i), slip = at_point(y, n, n_components, i);
      const double rho = rho_tangential_of(i);
      const DiscProjection friction =
          project_on_disc({{own[1] - rho * slip[1], own[2] - rho * slip[2]}}, problem.mu[i] * force);
      if (force > 0 && !friction.sticks)
        status[i] = ContactStatus::slip;
      for (unsigned int c = 1; c < n_components; ++c)
      {
        projected[c * n + i] = friction.force[c - 1];
        tangential_defect += std::pow(own[c] - friction.force[c - 1], 2);
      }
      friction_limit += std::pow(std::min(problem.mu[i], 1.) * force, 2);
    }
    if (normal_defect == 0 && tangential_defect == 0)
      return 0;
    if (normal == 0)
      return 1; // forces that all have to go: as wrong as can be
    if (friction_limit == 0)
      friction_limit = normal;
    constexpr double least = 1e-3;
    return std::sqrt(normal_defect / std::max(friction_limit, least * least * normal) +
                     tangential_defect / friction_limit);
  }

  std::vector<unsigned int> loaded_points(const DenseVector &R, const unsigned int n_points)
  {
    std::vector<unsigned int> points;
    for (unsigned int i = 0; i < n_points; ++i)
      for (unsigned int row = i; row < R.size(); row += n_points)
        if (R[row] != 0)
        {
          points.push_back(i);
          break;
        }
    return points;
  }

  void contact_response(const ContactProblem &problem, const DenseVector &R, const double approach,
                        DenseVector &y)
  {
    problem.A->vmult(y, R, loaded_points(R, problem.n_points()));
    y += problem.b;
    problem.move(y, approach);
  }
} // namespace vibrocontact
