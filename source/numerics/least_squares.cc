#include <vibrocontact/numerics/lapack_work.h>
#include <vibrocontact/numerics/least_squares.h>

#include <deal.II/lac/lapack_templates.h>

#include <algorithm>
#include <cmath>
#include <limits>

extern "C" void dgglse_(const int *, const int *, const int *, double *, const int *, double *, const int *,
                        double *, double *, double *, double *, const int *, int *);

namespace vibrocontact
{
  namespace
  {
    /// Scales the columns to length one. @return by what x has to be multiplied then
    std::vector<double> scale_columns(DenseMatrix &A)
    {
      std::vector<double> scale(A.n(), 1.);
      for (unsigned int j = 0; j < A.n(); ++j)
      {
        double sum = 0;
        for (unsigned int i = 0; i < A.m(); ++i)
          sum += A(i, j) * A(i, j);
        if (sum > 0)
          scale[j] = 1 / std::sqrt(sum);
        for (unsigned int i = 0; i < A.m(); ++i)
          A(i, j) *= scale[j];
      }
      return scale;
    }
  } // namespace

  DenseMatrix least_squares(DenseMatrix A, const DenseMatrix &B)
  {
    const int m = A.m(), n = A.n(), n_right = B.n(), rows = std::max(m, n);
    const std::vector<double> scale = scale_columns(A);
    DenseMatrix solution(rows, n_right);
    for (int j = 0; j < n_right; ++j)
      for (int i = 0; i < m; ++i)
        solution(i, j) = B(i, j);
    std::vector<double> singular(std::min(m, n));
    std::vector<int> integers(std::max(1, 50 * std::min(m, n)));
    // directions that the data do not determine get nothing
    const double threshold = 1e-14;
    int rank = 0;
    with_work("dgelsd",
              [&](double *work, const int &n_work, int &info)
              {
                dealii::gelsd(&m, &n, &n_right, &A(0, 0), &m, &solution(0, 0), &rows, singular.data(),
                              &threshold, &rank, work, &n_work, integers.data(), &info);
              });
    DenseMatrix x(n, n_right);
    for (int j = 0; j < n_right; ++j)
      for (int i = 0; i < n; ++i)
        x(i, j) = scale[i] * solution(i, j);
    return x;
  }

  DenseMatrix least_squares(const DenseMatrix &A, const DenseMatrix &B, const DenseMatrix &C,
                            const DenseMatrix &D)
  {
    const int n = A.n(), n_right = B.n(), n_equations = C.m(), all = n + n_right;
    // the rotations that make A triangular serve all right-hand sides
    DenseMatrix both(A.m(), all);
    for (unsigned int i = 0; i < A.m(); ++i)
    {
      for (int j = 0; j < n; ++j)
        both(i, j) = A(i, j);
      for (int j = 0; j < n_right; ++j)
        both(i, n + j) = B(i, j);
    }
    const DenseMatrix factor = triangular_factor(both);
    DenseMatrix R(n, n);
    for (int j = 0; j < n; ++j)
      for (int i = 0; i <= j; ++i)
        R(i, j) = factor(i, j);
    const std::vector<double> scale = scale_columns(R);
    DenseMatrix equations(n_equations, n), x(n, n_right);
    std::vector<double> length(n_equations, 0.);
    for (int k = 0; k < n_equations; ++k)
    {
      for (int j = 0; j < n; ++j)
        length[k] = std::hypot(length[k], C(k, j) * scale[j]);
      for (int j = 0; j < n; ++j)
        equations(k, j) = C(k, j) * scale[j] / length[k];
    }
    for (int j = 0; j < n_right; ++j)
    {
      DenseMatrix triangle = R, left = equations;
      std::vector<double> right(n), target(n_equations), solution(n);
      for (int i = 0; i < n; ++i)
        right[i] = factor(i, n + j);
      for (int k = 0; k < n_equations; ++k)
        target[k] = D(k, j) / length[k];
      bool is_undetermined = false;
      with_work("dgglse",
                [&](double *work, const int &n_work, int &info)
                {
                  dgglse_(&n, &n, &n_equations, &triangle(0, 0), &n, &left(0, 0), &n_equations, right.data(),
                          target.data(), solution.data(), work, &n_work, &info);
                  // 1: the side conditions depend on each other
                  is_undetermined = info == 2;
                  info = is_undetermined ? 0 : info;
                });
      if (is_undetermined)
        throw ConvergenceError(
            "The data do not determine as many unknowns as a fit to them has: ask for fewer "
            "(poles), or give more lines.");
      for (int i = 0; i < n; ++i)
        x(i, j) = scale[i] * solution[i];
    }
    return x;
  }

  DenseMatrix triangular_factor(DenseMatrix A)
  {
    const int m = A.m(), n = A.n();
    std::vector<double> tau(n);
    with_work("dgeqrf", [&](double *work, const int &n_work, int &info)
              { dealii::geqrf(&m, &n, &A(0, 0), &m, tau.data(), work, &n_work, &info); });
    // of fewer rows than columns the last rows are zero
    DenseMatrix R(n, n);
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < std::min(j + 1, m); ++i)
        R(i, j) = A(i, j);
    return R;
  }
} // namespace vibrocontact
