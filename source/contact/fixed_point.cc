#include <vibrocontact/contact/fixed_point.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>

namespace vibrocontact
{
  namespace
  {
    /// Largest singular value of the block of A that takes components [first, last) to themselves.
    double largest_gain(const ContactOperator &A, const unsigned int first, const unsigned int last)
    {
      const unsigned int n = A.n_points();
      std::vector<unsigned int> all(n);
      std::iota(all.begin(), all.end(), 0);
      DenseVector v(3 * n), image(3 * n);
      for (unsigned int k = first * n; k < last * n; ++k)
        v[k] = 1;
      v /= v.l2_norm();
      double gain = 0;
      for (unsigned int iteration = 0; iteration < 60; ++iteration)
      {
        A.vmult(image, v, all);
        for (unsigned int k = 0; k < 3 * n; ++k)
          if (k < first * n || k >= last * n)
            image[k] = 0;
        const double previous = gain;
        gain = image.l2_norm();
        v.equ(1 / gain, image);
        if (std::abs(gain - previous) < 1e-3 * gain)
          break;
      }
      return gain;
    }

    constexpr unsigned int iterations_per_check = 100;

    /// approach at which the projections of N - rho (gap - shift) sum to the force; shift is added to the
    /// approach
    double shift_for_force(const ContactProblem &problem, const DenseVector &R, const DenseVector &y,
                           const double rho)
    {
      const unsigned int n = problem.n_points();
      const auto sum = [&](const double shift)
      {
        double total = 0;
        for (unsigned int i = 0; i < n; ++i)
          total += problem.normal_law->project(R[i], y[i] - shift, rho).force;
        return total - problem.normal_force;
      };
      const double unit = problem.normal_force / rho / n;
      double low = -unit, high = unit;
      while (sum(low) > 0)
        low *= 2;
      while (sum(high) < 0)
        high *= 2;
      for (unsigned int k = 0; k < 200 && high - low > 1e-15 * (std::abs(low) + std::abs(high)); ++k)
      {
        const double middle = 0.5 * (low + high);
        (sum(middle) > 0 ? high : low) = middle;
      }
      return 0.5 * (low + high);
    }
  } // namespace

  ContactSolution FixedPointSolver::solve(const ContactProblem &problem, const ContactSolution &start)
  {
    const auto begin = std::chrono::steady_clock::now();
    const unsigned int n = problem.n_points();
    ContactSolution s = start;
    if (s.empty())
    {
      s.R.reinit(3 * n);
      s.approach = problem.approach;
    }
    else if (!problem.force_given())
      s.approach = problem.approach;
    s.iterations = s.factorisations = s.linear_iterations = s.fallbacks = 0;
    s.converged = false;

    const double rho_n = 1 / largest_gain(*problem.A, 0, 1);
    double rho_t = 1 / largest_gain(*problem.A, 1, 3);
    double largest_change = 0, previous_change = std::numeric_limits<double>::max();
    const ContactResidual residual(problem);
    DenseVector projected;
    contact_response(problem, s.R, s.approach, s.y);
    while (s.iterations < parameters.max_fixed_point_iterations)
    {
      ++s.iterations;
      const double shift = problem.force_given() ? shift_for_force(problem, s.R, s.y, rho_n) : 0;
      s.approach += shift;
      double change = 0, size = 0;
      for (unsigned int i = 0; i < n; ++i)
      {
        const double force = problem.normal_law->project(s.R[i], s.y[i] - shift, rho_n).force;
        const CoulombLaw::Projection friction =
            CoulombLaw::project({{s.R[n + i] - rho_t * s.y[n + i], s.R[2 * n + i] - rho_t * s.y[2 * n + i]}},
                                problem.mu[i] * force);
        const double next[3] = {force, friction.force[0], friction.force[1]};
        for (unsigned int c = 0; c < 3; ++c)
        {
          double &value = s.R[c * n + i];
          change += (next[c] - value) * (next[c] - value);
          size += next[c] * next[c];
          value = next[c];
        }
      }
      contact_response(problem, s.R, s.approach, s.y);
      if (change <= parameters.force_change * parameters.force_change * size)
        break;
      largest_change = std::max(largest_change, change / size);
      if (s.iterations % iterations_per_check == 0)
      {
        if (largest_change > 0.99 * previous_change)
        {
          rho_t *= 0.5;
          ++s.fallbacks;
          previous_change = std::numeric_limits<double>::max();
        }
        else
          previous_change = largest_change;
        largest_change = 0;
      }
    }
    s.residual = residual.evaluate(s.R, s.y, projected, s.status);
    s.converged = s.residual <= parameters.tolerance;
    s.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return s;
  }
} // namespace vibrocontact
