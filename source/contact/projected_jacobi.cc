#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/contact/projected_jacobi.h>
#include <vibrocontact/numerics/wide_loops.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vibrocontact
{
  namespace
  {
    constexpr double largest_factor = 0.1;
    /// errors shrink tenfold in each: more would be more than numbers have digits, from any start
    constexpr unsigned int most_iterations = 200;
  } // namespace

  bool ProjectedJacobi::takes(const ContactProblem &problem)
  {
    return problem.n_components() == 1 && !problem.force_given() &&
           problem.normal_law.all(&NormalLaw::is_rigid) && problem.A->mean_diagonal(0) > 0 &&
           problem.A->jacobi_factor() <= largest_factor;
  }

  void ProjectedJacobi::begin_with_earlier_ones()
  {
    // a constant, a straight line, a parabola
    constexpr double weights[4][3] = {{0, 0, 0}, {1, 0, 0}, {2, -1, 0}, {3, -3, 1}};
    std::rotate(by_others.begin(), by_others.end() - 1, by_others.end());
    const double *const w = weights[n_earlier];
    for (std::size_t i = 0; i < all.size(); ++i)
      by_others[0][i] = w[0] * by_others[1][i] + w[1] * by_others[2][i] + w[2] * by_others[3][i];
    n_earlier = std::min(n_earlier + 1, 3u);
  }

  void ProjectedJacobi::solve(const ContactProblem &problem, ContactSolution &state)
  {
    const unsigned int n = problem.n_points();
    if (state.R.size() != n || state.status.size() != n || state.y.size() != n)
    {
      state.R.reinit(n);
      state.y.reinit(n);
      state.status.resize(n);
    }
    if (all.size() != n)
    {
      all.resize(n);
      std::iota(all.begin(), all.end(), 0u);
      for (std::vector<double> &values : by_others)
        values.assign(n, 0.);
      n_earlier = 0;
    }
    state.approach = problem.approach;
    std::copy(problem.b.begin(), problem.b.end(), state.y.begin());
    if (state.approach != 0)
      problem.move(state.y, state.approach);
    double *const force = state.R.data(), *const gap = state.y.data();
    if (!std::isfinite(wide_dot(gap, gap, n)))
      throw ConvergenceError("The gaps of the contact problem '" + problem.title +
                             "' are no longer finite numbers.");
    const double diagonal = problem.A->mean_diagonal(0), factor = problem.A->jacobi_factor(),
                 stop = tolerance * (1 - factor) / std::max(factor, tolerance);
    begin_with_earlier_ones();
    for (unsigned int i = 0; i < n; ++i)
      force[i] = std::max(0., -(gap[i] + by_others[0][i]) / diagonal);
    state.cost() = {};
    state.response_known = false;
    double change = 0, size = 0;
    do
    {
      ++state.iterations;
      problem.A->vmult(response, state.R, all);
      wide_jacobi_step(force, by_others[0].data(), response.data(), gap, diagonal, n, change, size);
    } while (change > stop * stop * size && state.iterations < most_iterations);
    state.residual = size > 0 ? std::sqrt(change / size) * factor / (1 - factor) : 0.;
    state.converged = change <= stop * stop * size;
    for (unsigned int i = 0; i < n; ++i)
    {
      const bool shut = force[i] > 0;
      gap[i] = shut ? 0. : gap[i] + by_others[0][i];
      state.status[i] = shut ? ContactStatus::stick : ContactStatus::open;
    }
  }
} // namespace vibrocontact
