#include <vibrocontact/contact/few_points.h>
#include <vibrocontact/contact/laws/friction_law.h>

#include <deal.II/lac/lapack_templates.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vibrocontact
{
  namespace
  {
    constexpr unsigned int most_newton_steps = 30, most_sweeps = 2000;
    constexpr double accuracy = 1e-11;
    /// Where friction opens its own contact (mu A_nt > A_nn) whole projections alternate for ever; shorter ones, which take turns
    /// with them, do not.
    constexpr unsigned int sweeps_in_turn = 20;
    /// beyond, Newton on the points in contact alone costs less (doc/contact.md)
    constexpr unsigned int most_points = 4;

    /// columns of b <- matrix^-1 b; false if it is singular
    bool solve_linear(std::vector<double> &matrix, std::vector<dealii::types::blas_int> &pivots,
                      double *const b, const dealii::types::blas_int columns)
    {
      const dealii::types::blas_int m = pivots.size();
      dealii::types::blas_int info = 0;
      dealii::getrf(&m, &m, matrix.data(), &m, pivots.data(), &info);
      if (info == 0)
        dealii::getrs("N", &m, &columns, matrix.data(), &m, pivots.data(), b, &m, &info);
      return info == 0;
    }
  } // namespace

  bool FewPointsSolver::takes(const ContactProblem &problem)
  {
    return problem.n_points() <= most_points && !problem.force_given();
  }

  void FewPointsSolver::prepare(const ContactProblem &problem)
  {
    if (operator_of_matrix == problem.A)
      return;
    n = problem.n_points();
    n_components = problem.n_components();
    n_rows = problem.n_rows();
    std::vector<unsigned int> all(n);
    std::iota(all.begin(), all.end(), 0);
    problem.A->extract(all, A);
    b.reinit(n_rows);
    for (auto *const values : {&defect, &y, &trial, &step})
      values->resize(n_rows);
    for (auto *const values : {&by_R, &by_b, &factors})
      values->resize(n_rows * n_rows);
    pivots.resize(n_rows);
    operator_of_matrix = problem.A;
  }

  double FewPointsSolver::linearise(const ContactProblem &problem, const ContactResidual &judge,
                                    const double *const R)
  {
    const unsigned int m = n_rows;
    for (unsigned int i = 0; i < m; ++i)
    {
      y[i] = b[i];
      for (unsigned int j = 0; j < m; ++j)
        y[i] += A(i, j) * R[j];
    }
    std::fill(by_R.begin(), by_R.end(), 0.);
    std::fill(by_b.begin(), by_b.end(), 0.);
    double size = 0, largest = 0;
    for (unsigned int i = 0; i < n; ++i)
    {
      const double rho = A(i, i) > 0 ? 1 / A(i, i) : judge.rho_normal;
      const NormalLaw::Projection normal = problem.normal_law[i].project(R[i], y[i], rho);
      defect[i] = R[i] - normal.force;
      by_R[i * m + i] += 1 - normal.by_force;
      for (unsigned int j = 0; j < m; ++j)
        by_R[j * m + i] -= normal.by_gap * A(i, j);
      by_b[i * m + i] = -normal.by_gap;
      size = std::max({size, normal.force, rho * std::abs(b[i])});
      largest = std::max(largest, std::abs(defect[i]));
      if (n_components == 1)
        continue;

      double softest = 0;
      Vector2 pull{};
      for (unsigned int row = n + i; row < m; row += n)
        softest = std::max(softest, A(row, row));
      const double rho_t = softest > 0 ? 1 / softest : judge.rho_tangential;
      for (unsigned int a = 0, row = n + i; row < m; row += n, ++a)
        pull[a] = R[row] - rho_t * y[row];
      const DiscProjection tangential = project_on_disc(pull, problem.mu[i] * normal.force);
      for (unsigned int a = 0, row = n + i; row < m; row += n, ++a)
      {
        defect[row] = R[row] - tangential.force[a];
        largest = std::max(largest, std::abs(defect[row]));
        by_R[row * m + row] += 1;
        for (unsigned int c = 0, other = n + i; other < m; other += n, ++c)
        {
          const double by_trial = tangential.by_trial[a][c];
          by_R[other * m + row] -= by_trial;
          for (unsigned int j = 0; j < m; ++j)
            by_R[j * m + row] += by_trial * rho_t * A(other, j);
          by_b[other * m + row] += by_trial * rho_t;
        }
        const double by_force = problem.mu[i] * tangential.by_radius[a];
        if (by_force == 0)
          continue;
        by_R[i * m + row] -= by_force * normal.by_force;
        for (unsigned int j = 0; j < m; ++j)
          by_R[j * m + row] -= by_force * normal.by_gap * A(i, j);
        by_b[i * m + row] -= by_force * normal.by_gap;
      }
    }
    return largest / std::max(size, 1e-300);
  }

  /// One of Newton's steps; false if the defect does not fall, and R stays.
  bool FewPointsSolver::take_step(const ContactProblem &problem, const ContactResidual &judge,
                                  double *const R, double &error)
  {
    factors = by_R;
    step = defect;
    if (!solve_linear(factors, pivots, step.data(), 1))
      return false;
    for (unsigned int i = 0; i < n_rows; ++i)
      trial[i] = R[i] - step[i];
    const double next = linearise(problem, judge, trial.data());
    if (!(next < error))
    {
      linearise(problem, judge, R);
      return false;
    }
    std::copy(trial.begin(), trial.end(), R);
    error = next;
    return true;
  }

  bool FewPointsSolver::find(const ContactProblem &problem, const ContactResidual &judge,
                             ContactSolution &state, double &error)
  {
    double *const R = state.R.data();
    error = linearise(problem, judge, R);
    for (unsigned int sweep = 0; sweep < most_sweeps; ++sweep)
    {
      for (unsigned int k = 0; k < most_newton_steps && error > accuracy; ++k)
      {
        ++state.iterations;
        if (!take_step(problem, judge, R, error))
          break;
      }
      if (error <= accuracy)
        return true;
      const unsigned int turn = sweep / sweeps_in_turn;
      error = project(problem, judge, R, turn % 2 == 0 ? 1. : 1. / (1 + turn));
    }
    return false;
  }

  /// One point after the other goes towards its projection.
  double FewPointsSolver::project(const ContactProblem &problem, const ContactResidual &judge,
                                  double *const R, const double relaxation)
  {
    for (unsigned int i = 0; i < n; ++i)
    {
      linearise(problem, judge, R);
      for (unsigned int row = i; row < n_rows; row += n)
        R[row] -= relaxation * defect[row];
    }
    return linearise(problem, judge, R);
  }

  void FewPointsSolver::solve(const ContactProblem &problem, ContactSolution &state)
  {
    check_finite(problem);
    prepare(problem);
    if (!state.is_finite())
      state = ContactSolution();
    if (state.R.size() != n_rows)
      state.R.reinit(n_rows);
    state.approach = problem.approach;
    std::copy_n(problem.b.begin(), n_rows, b.begin());
    if (state.approach != 0)
      problem.move(b, state.approach);
    state.cost() = {};
    state.response_known = false;
    const ContactResidual judge(problem);
    double error = 0;
    bool is_found = find(problem, judge, state, error);
    const auto respond = [&]
    {
      if (problem.b.size() > n_rows)
        contact_response(problem, state.R, state.approach, state.y);
      else
      {
        if (state.y.size() != n_rows)
          state.y.reinit(n_rows);
        std::copy(y.begin(), y.end(), state.y.begin());
      }
      state.residual = judge.evaluate(state.R, state.y, projected, state.status);
    };
    respond();
    while (is_found && state.residual > tolerance)
    {
      is_found = take_step(problem, judge, state.R.data(), error);
      // forces that are left by rounding go where they belong
      if (!is_found)
        project(problem, judge, state.R.data());
      ++state.iterations;
      respond();
    }
    state.converged = state.residual <= tolerance;
  }

  bool FewPointsSolver::sensitivity(double *const rates)
  {
    factors = by_R;
    for (std::size_t k = 0; k < by_b.size(); ++k)
      rates[k] = -by_b[k];
    return solve_linear(factors, pivots, rates, n_rows);
  }
} // namespace vibrocontact
