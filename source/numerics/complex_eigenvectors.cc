#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/numerics/complex_eigenvectors.h>

#include <deal.II/lac/lapack_templates.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    using Complex = std::complex<double>;

    /// Largest entry of A - right diag(values) left over that of A.
    double missing(const dealii::LAPACKFullMatrix<Complex> &A, const ComplexEigenvectors &found)
    {
      const unsigned int n = A.m();
      dealii::LAPACKFullMatrix<Complex> scaled(n, n), product(n, n);
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          scaled(i, j) = Complex(found.right(i, j)) * found.values[j];
      scaled.mmult(product, found.left);
      double size = 0, worst = 0;
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
        {
          size = std::max(size, std::abs(Complex(A(i, j))));
          worst = std::max(worst, std::abs(Complex(product(i, j)) - Complex(A(i, j))));
        }
      return size > 0 ? worst / size : 0;
    }
    /// zgeev; deal.II's compute_eigenvalues() stops in its debug library, which mistakes the size of a work array.
    /// @param right eigenvectors, none if empty
    std::vector<Complex> eigenvalues(dealii::LAPACKFullMatrix<Complex> &A, const std::string &of,
                                     dealii::LAPACKFullMatrix<Complex> &right)
    {
      const dealii::types::blas_int size = A.m(), one = 1, n_work = 8 * size;
      std::vector<Complex> values(size), work(n_work);
      std::vector<double> real_work(2 * size);
      dealii::types::blas_int info = 0;
      Complex *const none = nullptr;
      const bool with_vectors = right.m() > 0;
      dealii::geev("N", with_vectors ? "V" : "N", &size, &A(0, 0), &size, values.data(), none, &one,
                   with_vectors ? &right(0, 0) : none, with_vectors ? &size : &one, work.data(), &n_work,
                   real_work.data(), &info);
      if (info != 0)
        throw ConvergenceError("LAPACK found no " + of + " (zgeev: " + std::to_string(info) + ").");
      return values;
    }
  } // namespace

  std::vector<Complex> complex_eigenvalues(dealii::LAPACKFullMatrix<Complex> A, const std::string &of)
  {
    dealii::LAPACKFullMatrix<Complex> none;
    return eigenvalues(A, of, none);
  }

  ComplexEigenvectors complex_eigenvectors(dealii::LAPACKFullMatrix<std::complex<double>> A,
                                           const std::string &of)
  {
    const unsigned int n = A.m();
    const dealii::LAPACKFullMatrix<Complex> given(A);
    ComplexEigenvectors result;
    result.right.reinit(n, n);
    result.left.reinit(n, n);
    result.values = eigenvalues(A, of, result.right);
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        result.left(i, j) = result.right(i, j);
    result.left.invert();
    const double error = missing(given, result);
    if (!(error < 1e-6))
      throw ConvergenceError("There are not as many independent eigenvectors as " + of +
                             ": two of them are one (their sum leaves " + number_text(error) +
                             " of the matrix); change a stiffness, a speed or a frequency by a millionth.");
    return result;
  }
} // namespace vibrocontact
