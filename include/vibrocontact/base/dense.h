#pragma once

#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

namespace vibrocontact
{
  /// Dense matrices are column-major and go to LAPACK and BLAS; no other dense type is used between the
  /// steps.
  using DenseMatrix = dealii::LAPACKFullMatrix<double>;
  using DenseVector = dealii::Vector<double>;
  /// of preconditioners
  using SingleMatrix = dealii::LAPACKFullMatrix<float>;

  /// Factorises a symmetric matrix in place by Cholesky. Returns false if it is not positive definite (or not
  /// finite): deal.II's own function throws what no caller expects.
  inline bool factorise_cholesky(DenseMatrix &matrix)
  {
    matrix.set_property(dealii::LAPACKSupport::symmetric);
    try
    {
      matrix.compute_cholesky_factorization();
    }
    catch (const dealii::ExceptionBase &)
    {
      return false;
    }
    return true;
  }
} // namespace vibrocontact
