#pragma once

#include <vibrocontact/base/dense.h>

#include <optional>

namespace vibrocontact
{
  /// Orthonormal basis of the vectors z of N entries with columns^T z = 0, by a QR factorisation of the columns;
  /// nothing if these depend on each other (to 1e-10) or are more than N.
  /// @param columns N x n, n may be 0; @return N x (N - n)
  std::optional<DenseMatrix> null_space(DenseMatrix columns, unsigned int N);
} // namespace vibrocontact
