#pragma once

#include <vibrocontact/base/dense.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  /// Largest entry of a - b over the largest of a.
  inline double difference(const DenseMatrix &a, const DenseMatrix &b)
  {
    double largest = 0, scale = 0;
    for (unsigned int j = 0; j < a.n(); ++j)
      for (unsigned int i = 0; i < a.m(); ++i)
      {
        largest = std::max(largest, std::abs(a(i, j) - b(i, j)));
        scale = std::max(scale, std::abs(a(i, j)));
      }
    return largest / scale;
  }
} // namespace vibrocontact
