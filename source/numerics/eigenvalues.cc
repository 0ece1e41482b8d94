#include <vibrocontact/numerics/eigenvalues.h>
#include <vibrocontact/numerics/lapack_work.h>

#include <deal.II/lac/lapack_templates.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vibrocontact
{
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

  Eigenvalues eigenvalues(DenseMatrix matrix, const bool with_left_vectors)
  {
    const int n = matrix.m();
    Eigenvalues result;
    result.vectors.reinit(n);
    result.left.reinit(with_left_vectors ? n : 1);
    const int n_left = result.left.m();
    std::vector<double> real(n), imaginary(n);
    with_work("dgeev",
              [&](double *work, const int &n_work, int &info)
              {
                dealii::geev(with_left_vectors ? "V" : "N", "V", &n, &matrix(0, 0), &n, real.data(),
                             imaginary.data(), &result.left(0, 0), &n_left, &result.vectors(0, 0), &n, work,
                             &n_work, &info);
              });
    for (int k = 0; k < n; ++k)
      result.values.emplace_back(real[k], imaginary[k]);
    return result;
  }
} // namespace vibrocontact
