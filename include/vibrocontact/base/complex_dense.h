#pragma once

#include <vibrocontact/base/dense.h>

#include <complex>

namespace vibrocontact
{
  using ComplexMatrix = dealii::LAPACKFullMatrix<std::complex<double>>;
  using ComplexVector = dealii::Vector<std::complex<double>>;

  /// A x
  inline ComplexVector product(const ComplexMatrix &A, const ComplexVector &x)
  {
    ComplexVector y(A.m());
    if (A.m() > 0 && A.n() > 0)
      A.vmult(y, x);
    return y;
  }

  /// real + j imaginary, of equal sizes
  inline ComplexMatrix complex_matrix(const DenseMatrix &real, const DenseMatrix &imaginary)
  {
    ComplexMatrix result(real.m(), real.n());
    for (unsigned int j = 0; j < real.n(); ++j)
      for (unsigned int i = 0; i < real.m(); ++i)
        result(i, j) = {real(i, j), imaginary(i, j)};
    return result;
  }

  /// The same entries as numbers of a kind.
  template <typename Number>
  dealii::LAPACKFullMatrix<Number> entries_as(const DenseMatrix &matrix)
  {
    dealii::LAPACKFullMatrix<Number> result(matrix.m(), matrix.n());
    for (unsigned int j = 0; j < matrix.n(); ++j)
      for (unsigned int i = 0; i < matrix.m(); ++i)
        result(i, j) = matrix(i, j);
    return result;
  }

  /// What a real linear map of columns makes of a matrix: of a complex one, of both its parts.
  template <typename Map>
  DenseMatrix mapped(const DenseMatrix &matrix, const Map &map)
  {
    return map(matrix);
  }
  template <typename Map>
  ComplexMatrix mapped(const ComplexMatrix &matrix, const Map &map)
  {
    DenseMatrix real(matrix.m(), matrix.n()), imaginary(matrix.m(), matrix.n());
    for (unsigned int j = 0; j < matrix.n(); ++j)
      for (unsigned int i = 0; i < matrix.m(); ++i)
      {
        real(i, j) = matrix(i, j).real();
        imaginary(i, j) = matrix(i, j).imag();
      }
    return complex_matrix(map(real), map(imaginary));
  }
} // namespace vibrocontact
