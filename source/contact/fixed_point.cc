#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/contact/fixed_point.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vibrocontact
{
  namespace
  {
    /// Growth per step of the power iteration with the block of A that takes components [first, last) at some
    /// points to themselves; see fixed_point.h for what that is worth.
    double growth(const ContactOperator &A, const std::vector<unsigned int> &points, const unsigned int first,
                  const unsigned int last)
    {
      const unsigned int n = A.n_points();
      DenseVector v(n * A.n_components()), image(v.size());
      for (unsigned int c = first; c < last; ++c)
        for (const unsigned int i : points)
          v[c * n + i] = 1;
      v /= v.l2_norm();
      double gain = 0;
      for (unsigned int iteration = 0; iteration < 60; ++iteration)
      {
        A.vmult(image, v, points);
        v = 0;
        for (unsigned int c = first; c < last; ++c)
          for (const unsigned int i : points)
            v[c * n + i] = image[c * n + i];
        const double previous = gain;
        gain = v.l2_norm();
        if (!std::isfinite(gain))
          throw ConvergenceError("The contact operator has no finite compliance; check the bodies that it is "
                                 "made of.");
        if (gain == 0)
          return 0;
        v /= gain;
        if (std::abs(gain - previous) < 1e-3 * gain)
          break;
      }
      return gain;
    }

    /// The points that carry forces, and the constant rho that goes with them.
    class Steps
    {
    public:
      explicit Steps(const ContactProblem &problem) : A(*problem.A), n(problem.n_points()), carries(n, true)
      {
        find();
      }

      /// Takes loaded points in that were not there; what has no force for a while is left out by `shrink`.
      void follow(const DenseVector &R, const bool shrink)
      {
        bool changes = false;
        for (unsigned int i = 0; i < n; ++i)
          if (R[i] > 0 ? !carries[i] : shrink && carries[i])
          {
            carries[i] = !carries[i];
            changes = true;
          }
        if (changes)
          find();
      }

      double normal = 0, tangential = 0;
      double tangential_factor = 1;

    private:
      void find()
      {
        std::vector<unsigned int> points;
        for (unsigned int i = 0; i < n; ++i)
          if (carries[i])
            points.push_back(i);
        if (points.empty())
          return;
        const double compliance = growth(A, points, 0, 1);
        if (compliance == 0)
          throw ConvergenceError(
              "The contact operator does not yield to normal forces, so that the fixed point has "
              "no step: take another Contact/Solver/Method.");
        normal = 1 / compliance;
        tangential = 1;
        if (A.n_components() == 1)
          return;
        const double slip = growth(A, points, 1, A.n_components());
        // of bodies that slide without rolling it follows no forces: a long step gives their direction at once
        constexpr double long_step = 1e20;
        tangential = slip > 0 ? 1 / slip : long_step * normal;
      }

      const ContactOperator &A;
      const unsigned int n;
      std::vector<bool> carries;
    };

    constexpr unsigned int iterations_per_check = 100;

    /// approach at which the projections of N - rho (gap - shift a) add up to the force, with the tangential forces as they
    /// are; shift is added to the approach
    /// @param approach, share a and l of each point
    double shift_for_force(const ContactProblem &problem, const std::vector<std::array<double, 3>> &approach,
                           const std::vector<std::array<double, 3>> &share, const DenseVector &R,
                           const DenseVector &y, const double rho)
    {
      const unsigned int n = problem.n_points(), n_components = problem.n_components();
      const auto sum = [&](const double shift)
      {
        double total = 0;
        for (unsigned int i = 0; i < n; ++i)
        {
          const std::array<double, 3> &l = share[i], force = at_point(R, n, n_components, i);
          total += l[0] * problem.normal_law[i].project(R[i], y[i] - shift * approach[i][0], rho).force +
                   l[1] * force[1] + l[2] * force[2];
        }
        return total - problem.normal_force;
      };
      const double unit = problem.normal_force / rho / n;
      double low = -unit, high = unit;
      while (sum(low) > 0 && std::isfinite(low))
        low *= 2;
      while (sum(high) < 0 && std::isfinite(high))
        high *= 2;
      if (!std::isfinite(low) || !std::isfinite(high))
        throw ConvergenceError("No approach gives the normal force of the contact problem '" + problem.title +
                               "': its gaps are not finite numbers; check the bodies that it is made of.");
      for (unsigned int k = 0; k < 200 && high - low > 1e-15 * (std::abs(low) + std::abs(high)); ++k)
      {
        const double middle = 0.5 * (low + high);
        (sum(middle) > 0 ? high : low) = middle;
      }
      return 0.5 * (low + high);
    }
  } // namespace

  void FixedPointSolver::solve(const ContactProblem &problem, ContactSolution &s)
  {
    const unsigned int n = problem.n_points(), n_components = problem.n_components();
    check_finite(problem);
    if (!s.is_finite())
      s = ContactSolution();
    if (s.empty())
    {
      s.R.reinit(problem.n_rows());
      s.approach = problem.approach;
    }
    else if (!problem.force_given())
      s.approach = problem.approach;
    s.cost() = {};
    s.converged = s.response_known = false;

    std::vector<std::array<double, 3>> approach(n), share(n);
    for (unsigned int i = 0; i < n; ++i)
    {
      approach[i] = problem.approach_of(i);
      share[i] = problem.share_of(i);
    }
    Steps rho(problem);
    double largest_change = 0, previous_change = std::numeric_limits<double>::max();
    const ContactResidual residual(problem);
    DenseVector projected;
    contact_response(problem, s.R, s.approach, s.y);
    while (s.iterations < parameters.max_fixed_point_iterations)
    {
      ++s.iterations;
      const double rho_n = rho.normal, rho_t = rho.tangential_factor * rho.tangential;
      const double shift =
          problem.force_given() ? shift_for_force(problem, approach, share, s.R, s.y, rho_n) : 0;
      s.approach += shift;
      double change = 0, size = 0;
      for (unsigned int i = 0; i < n; ++i)
      {
        const std::array<double, 3> &a = approach[i], own = at_point(s.R, n, n_components, i),
                                    slip = at_point(s.y, n, n_components, i);
        const double force = problem.normal_law[i].project(s.R[i], s.y[i] - shift * a[0], rho_n).force;
        const DiscProjection friction = project_on_disc(
            {{own[1] - rho_t * (slip[1] - shift * a[1]), own[2] - rho_t * (slip[2] - shift * a[2])}},
            n_components > 1 ? problem.mu[i] * force : 0.);
        const double next[3] = {force, friction.force[0], friction.force[1]};
        for (unsigned int c = 0; c < n_components; ++c)
        {
          double &value = s.R[c * n + i];
          change += (next[c] - value) * (next[c] - value);
          size += next[c] * next[c];
          value = next[c];
        }
      }
      contact_response(problem, s.R, s.approach, s.y);
      if (!std::isfinite(change))
        break;
      if (change <= parameters.force_change * parameters.force_change * size)
        break;
      largest_change = std::max(largest_change, change / size);
      if (s.iterations % iterations_per_check == 0)
      {
        if (largest_change > 0.99 * previous_change)
        {
          rho.tangential_factor *= 0.5;
          ++s.fallbacks;
          previous_change = std::numeric_limits<double>::max();
        }
        else
          previous_change = largest_change;
        largest_change = 0;
      }
      rho.follow(s.R, s.iterations % iterations_per_check == 0);
    }
    s.residual = residual.evaluate(s.R, s.y, projected, s.status);
    if (!std::isfinite(s.residual))
      throw ConvergenceError("The fixed point of the contact problem '" + problem.title +
                             "' left the finite numbers; use Contact/Solver/Method = semi-smooth newton.");
    s.converged = s.residual <= parameters.tolerance;
  }
} // namespace vibrocontact
