#pragma once

#include <vibrocontact/base/dense.h>

#include <vector>

namespace vibrocontact
{
  /// min x^T K x / 2 - h^T x over x >= 0 with a symmetric positive semidefinite K, by active sets (Bro & de Jong 1997, J.
  /// Chemometrics 11, 393: Lawson and Hanson's method on the normal equations). The diagonal is raised by 1e-12 of
  /// itself: of rows that say the same, one is enough.
  /// @param start a solution for the first start.size() unknowns, or empty
  std::vector<double> nonnegative_minimum(const DenseMatrix &K, const std::vector<double> &h,
                                          const std::vector<double> &start = {});
} // namespace vibrocontact
