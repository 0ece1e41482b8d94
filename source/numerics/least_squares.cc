#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/numerics/least_squares.h>

#include <deal.II/lac/lapack_templates.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

extern "C" void dgglse_(const int *, const int *, const int *, double *, const int *, double *, const int *,
                        double *, double *, double *, double *, const int *, int *);

namespace vibrocontact
{
  namespace
  {
    /// Asks a LAPACK function for the work it needs, then runs it.
    void with_work(const char *name,
                   const std::function<void(double *work, const int &n_work, int &info)> &call)
    {
      int info = 0, n_work = -1;
      double wanted = 0;
      call(&wanted, n_work, info);
      n_work = static_cast<int>(wanted);
      std::vector<double> work(std::max(1, n_work));
      call(work.data(), n_work, info);
      if (info != 0)
        throw ConvergenceError(std::string("LAPACK's ") + name + " failed: " + std::to_string(info) + ".");
    }

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
      with_work("dgglse",
                [&](double *work, const int &n_work, int &info)
                {
                  dgglse_(&n, &n, &n_equations, &triangle(0, 0), &n, &left(0, 0), &n_equations, right.data(),
                          target.data(), solution.data(), work, &n_work, &info);
                });
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

  std::vector<std::complex<double>> general_eigenvalues(DenseMatrix A)
  {
    const int n = A.n(), one = 1;
    std::vector<double> real(n), imaginary(n);
    double none = 0;
    with_work("dgeev",
              [&](double *work, const int &n_work, int &info)
              {
                dealii::geev("N", "N", &n, &A(0, 0), &n, real.data(), imaginary.data(), &none, &one, &none,
                             &one, work, &n_work, &info);
              });
    std::vector<std::complex<double>> result(n);
    for (int k = 0; k < n; ++k)
      result[k] = {real[k], imaginary[k]};
    return result;
  }

  std::vector<double> symmetric_eigenvalues(const DenseMatrix &A, DenseMatrix &vectors)
  {
    const int n = A.n();
    vectors.reinit(n, n);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        vectors(i, j) = (A(i, j) + A(j, i)) / 2;
    std::vector<double> values(n);
    with_work("dsyev", [&](double *work, const int &n_work, int &info)
              { dealii::syev("V", "U", &n, &vectors(0, 0), &n, values.data(), work, &n_work, &info); });
    return values;
  }

  double definiteness(const DenseMatrix &A)
  {
    DenseMatrix vectors;
    const std::vector<double> values = symmetric_eigenvalues(A, vectors);
    return values.front() /
           std::max({std::abs(values.front()), std::abs(values.back()), std::numeric_limits<double>::min()});
  }
} // namespace vibrocontact
