#include <vibrocontact/analyses/periodic/massless_points.h>

namespace vibrocontact
{
  MasslessPoints::MasslessPoints(const DenseMatrix &residual, const unsigned int rows_per_point,
                                 const std::vector<double> &friction)
      : S(residual), n(residual.m()), per_point(rows_per_point), by_b(n * n)
  {
    DenseMatrix A(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        A(at(i), at(j)) = sign(i) * sign(j) * S(i, j);
    problem.title = "contact points without mass";
    problem.A = std::make_shared<DenseContactOperator>(A, per_point);
    problem.b.reinit(n);
    problem.mu = friction;
    solution.R.reinit(n);
  }

  bool MasslessPoints::solve(const std::vector<double> &w, const double *const before,
                             const std::vector<double> &gap, std::vector<double> &p)
  {
    for (unsigned int i = 0; i < n; ++i)
    {
      problem.b[at(i)] = is_normal(i) ? gap[i / per_point] - w[i] : w[i] - before[i];
      solution.R[at(i)] = sign(i) * p[i];
    }
    contact.solve(problem, solution);
    for (unsigned int i = 0; i < n; ++i)
      p[i] = sign(i) * solution.R[at(i)];
    return solution.converged;
  }

  bool MasslessPoints::rates(double *const by_w)
  {
    const bool solved = contact.sensitivity(by_b.data());
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        by_w[i * n + j] = sign(i) * sign(j) * by_b[at(j) * n + at(i)];
    return solved;
  }
} // namespace vibrocontact
