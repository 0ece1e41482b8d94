#include <vibrocontact/numerics/eigenvalues.h>
#include <vibrocontact/numerics/lapack_work.h>

#include <deal.II/lac/lapack_templates.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vibrocontact
{
  namespace
  {
    /// @param A is lost @param left, right eigenvectors; of no rows: not asked for
    std::vector<std::complex<double>> geev(DenseMatrix &A, DenseMatrix &left, DenseMatrix &right)
    {
      const int n = A.m(), n_left = std::max(1u, left.m()), n_right = std::max(1u, right.m());
      const bool with_left = left.m() > 0, with_right = right.m() > 0;
      double none = 0;
      std::vector<double> real(n), imaginary(n);
      with_work("dgeev",
                [&](double *work, const int &n_work, int &info)
                {
                  dealii::geev(with_left ? "V" : "N", with_right ? "V" : "N", &n, &A(0, 0), &n, real.data(),
                               imaginary.data(), with_left ? &left(0, 0) : &none, &n_left,
                               with_right ? &right(0, 0) : &none, &n_right, work, &n_work, &info);
                });
      std::vector<std::complex<double>> values;
      for (int k = 0; k < n; ++k)
        values.emplace_back(real[k], imaginary[k]);
      return values;
    }
  } // namespace

  std::vector<std::complex<double>> general_eigenvalues(DenseMatrix A)
  {
    DenseMatrix left, right;
    return geev(A, left, right);
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
    Eigenvalues result;
    result.vectors.reinit(matrix.m());
    result.left.reinit(with_left_vectors ? matrix.m() : 0);
    result.values = geev(matrix, result.left, result.vectors);
    return result;
  }
} // namespace vibrocontact
