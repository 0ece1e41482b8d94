#include <vibrocontact/contact/few_points.h>
#include <vibrocontact/contact/laws/friction_law.h>

#include <deal.II/lac/lapack_templates.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    constexpr unsigned int most_newton_steps = 30, most_sweeps = 2000;
    constexpr double accuracy = 1e-11;

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

  FewPoints::FewPoints(DenseMatrix matrix, const double mu, std::shared_ptr<const NormalLaw> law)
      : n(matrix.m() / 3), A(std::move(matrix)), mu(mu), law(std::move(law)), defect(3 * n), by_R(9 * n * n),
        by_b(9 * n * n), y(3 * n), trial(3 * n), step(3 * n), factors(9 * n * n), pivots(3 * n), statuses(n)
  {
  }

  double FewPoints::linearise(const double *const b, const double *const R)
  {
    const unsigned int m = 3 * n;
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
      const double rho = 1 / A(i, i);
      const NormalLaw::Projection normal = law->project(R[i], y[i], rho);
      defect[i] = R[i] - normal.force;
      by_R[i * m + i] += 1 - normal.by_force;
      for (unsigned int j = 0; j < m; ++j)
        by_R[j * m + i] -= normal.by_gap * A(i, j);
      by_b[i * m + i] = -normal.by_gap;

      const unsigned int row[2] = {n + i, 2 * n + i};
      const double rho_t = 1 / std::max(A(row[0], row[0]), A(row[1], row[1]));
      const DiscProjection tangential = project_on_disc(
          {{R[row[0]] - rho_t * y[row[0]], R[row[1]] - rho_t * y[row[1]]}}, mu * normal.force);
      for (unsigned int a = 0; a < 2; ++a)
      {
        defect[row[a]] = R[row[a]] - tangential.force[a];
        by_R[row[a] * m + row[a]] += 1;
        for (unsigned int c = 0; c < 2; ++c)
        {
          const double by_trial = tangential.by_trial[a][c];
          by_R[row[c] * m + row[a]] -= by_trial;
          for (unsigned int j = 0; j < m; ++j)
            by_R[j * m + row[a]] += by_trial * rho_t * A(row[c], j);
          by_b[row[c] * m + row[a]] += by_trial * rho_t;
        }
        const double by_force = mu * tangential.by_radius[a];
        if (by_force == 0)
          continue;
        by_R[i * m + row[a]] -= by_force * normal.by_force;
        for (unsigned int j = 0; j < m; ++j)
          by_R[j * m + row[a]] -= by_force * normal.by_gap * A(i, j);
        by_b[i * m + row[a]] -= by_force * normal.by_gap;
      }
      statuses[i] = normal.force <= 0   ? ContactStatus::open
                    : tangential.sticks ? ContactStatus::stick
                                        : ContactStatus::slip;
      size = std::max({size, normal.force, rho * std::abs(b[i])});
      for (const unsigned int k : {i, row[0], row[1]})
        largest = std::max(largest, std::abs(defect[k]));
    }
    return largest / std::max(size, 1e-300);
  }

  bool FewPoints::solve(const double *const b, double *const R)
  {
    double error = linearise(b, R);
    for (unsigned int sweep = 0; sweep < most_sweeps; ++sweep)
    {
      for (unsigned int k = 0; k < most_newton_steps && error > accuracy; ++k)
      {
        factors = by_R;
        step = defect;
        if (!solve_linear(factors, pivots, step.data(), 1))
          break;
        for (unsigned int i = 0; i < 3 * n; ++i)
          trial[i] = R[i] - step[i];
        const double next = linearise(b, trial.data());
        if (!(next < error))
        {
          linearise(b, R);
          break;
        }
        std::copy(trial.begin(), trial.end(), R);
        error = next;
      }
      if (error <= accuracy)
        return true;
      for (unsigned int i = 0; i < n; ++i)
      {
        linearise(b, R);
        for (unsigned int c = 0; c < 3; ++c)
          R[c * n + i] -= defect[c * n + i];
      }
      error = linearise(b, R);
    }
    return false;
  }

  bool FewPoints::sensitivity(double *const rates)
  {
    factors = by_R;
    for (std::size_t k = 0; k < by_b.size(); ++k)
      rates[k] = -by_b[k];
    return solve_linear(factors, pivots, rates, 3 * n);
  }
} // namespace vibrocontact
