#pragma once

#include <deal.II/lac/lapack_full_matrix.h>

#include <complex>
#include <vector>

namespace vibrocontact
{
  /// A = left diag(values) right (zgesdd) of an m x n matrix, with k = min(m, n): left is m x k and right k x n (the
  /// first columns of U, the first rows of V^H), values fall.
  ///
  /// deal.II's compute_svd() finds the same, but its debug library (9.4) takes the size of the complex work array
  /// for that of the real one, so that it stops at most matrices that are not large squares.
  struct ComplexSingularValues
  {
    std::vector<double> values;
    dealii::LAPACKFullMatrix<std::complex<double>> left, right;
  };

  /// @param A not empty @throws ConvergenceError if LAPACK finds none, as of entries that are no numbers
  ComplexSingularValues complex_singular_values(dealii::LAPACKFullMatrix<std::complex<double>> A);
} // namespace vibrocontact
