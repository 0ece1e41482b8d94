#pragma once

#include <deal.II/lac/lapack_full_matrix.h>

#include <complex>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// A = right diag(values) left with left = right^-1 (zgeev), of a matrix that has as many eigenvectors as columns.
  struct ComplexEigenvectors
  {
    std::vector<std::complex<double>> values;
    dealii::LAPACKFullMatrix<std::complex<double>> right, left;
  };

  /// @param A not empty @param of what they are, for the message @throws ConvergenceError
  std::vector<std::complex<double>> complex_eigenvalues(dealii::LAPACKFullMatrix<std::complex<double>> A,
                                                        const std::string &of);

  /// @param of what they are, for the message @throws ConvergenceError
  ComplexEigenvectors complex_eigenvectors(dealii::LAPACKFullMatrix<std::complex<double>> A,
                                           const std::string &of);
} // namespace vibrocontact
