#pragma once

#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

namespace vibrocontact
{
  /// Dense matrices are column-major and go to LAPACK and BLAS; no other dense type is used between the
  /// steps.
  using DenseMatrix = dealii::LAPACKFullMatrix<double>;
  using DenseVector = dealii::Vector<double>;
} // namespace vibrocontact
