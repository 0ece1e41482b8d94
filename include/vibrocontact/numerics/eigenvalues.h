#pragma once

#include <vibrocontact/base/dense.h>

#include <complex>
#include <vector>

namespace vibrocontact
{
  /// Eigenvalues of a real matrix (dgeev). @throws ConvergenceError
  std::vector<std::complex<double>> general_eigenvalues(DenseMatrix A);

  /// Eigenvalues of the symmetric part of a matrix, ascending (dsyev), with its vectors in the columns of `vectors`.
  std::vector<double> symmetric_eigenvalues(const DenseMatrix &A, DenseMatrix &vectors);

  /// Smallest eigenvalue of the symmetric part of a matrix over the largest modulus: <= 0 if x^T A x > 0 fails.
  double definiteness(const DenseMatrix &A);

  /// Eigenvalues of a real matrix, and right eigenvectors (x, A x = lambda x) as dgeev lays them out (conjugate
  /// pairs in two columns); left ones (y, y^H A = lambda y^H) if they are asked for.
  /// @throws ConvergenceError if LAPACK finds none
  struct Eigenvalues
  {
    std::vector<std::complex<double>> values;
    DenseMatrix vectors, left;
    /// of eigenvalue k with a positive (or no) imaginary part
    std::complex<double> component(const unsigned int i, const unsigned int k) const
    {
      return {vectors(i, k), values[k].imag() > 0 ? vectors(i, k + 1) : 0.};
    }
    std::complex<double> left_component(const unsigned int i, const unsigned int k) const
    {
      return {left(i, k), values[k].imag() > 0 ? left(i, k + 1) : 0.};
    }
  };
  Eigenvalues eigenvalues(DenseMatrix matrix, bool with_left_vectors = false);
} // namespace vibrocontact
