#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/numerics/complex_eigenvectors.h>

#include <deal.II/lac/lapack_templates.h>

namespace vibrocontact
{
  ComplexEigenvectors complex_eigenvectors(dealii::LAPACKFullMatrix<std::complex<double>> A,
                                           const std::string &of)
  {
    using Complex = std::complex<double>;
    const unsigned int n = A.m();
    ComplexEigenvectors result;
    result.values.resize(n);
    result.right.reinit(n, n);
    result.left.reinit(n, n);
    const dealii::types::blas_int size = n, one = 1, n_work = 8 * n;
    std::vector<Complex> work(n_work);
    std::vector<double> real_work(2 * n);
    dealii::types::blas_int info = 0;
    Complex *const none = nullptr;
    dealii::geev("N", "V", &size, &A(0, 0), &size, result.values.data(), none, &one, &result.right(0, 0),
                 &size, work.data(), &n_work, real_work.data(), &info);
    if (info != 0)
      throw ConvergenceError("LAPACK found no " + of + " (zgeev: " + std::to_string(info) + ").");
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        result.left(i, j) = result.right(i, j);
    result.left.invert();
    return result;
  }
} // namespace vibrocontact
