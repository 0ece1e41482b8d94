#pragma once

#include <vibrocontact/base/dense.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

namespace vibrocontact
{
  /// Largest entry of a - b over the largest of a, of real or complex matrices.
  template <typename Number>
  double difference(const dealii::LAPACKFullMatrix<Number> &a, const dealii::LAPACKFullMatrix<Number> &b)
  {
    double largest = 0, scale = 0;
    for (unsigned int j = 0; j < a.n(); ++j)
      for (unsigned int i = 0; i < a.m(); ++i)
      {
        largest = std::max(largest, std::abs(a(i, j) - b(i, j)));
        scale = std::max(scale, std::abs(a(i, j)));
      }
    return largest == 0 ? 0. : largest / scale;
  }

  /// The same of vectors.
  inline double difference(const std::vector<double> &a, const std::vector<double> &b)
  {
    double largest = 0, scale = 0;
    for (std::size_t k = 0; k < a.size(); ++k)
    {
      largest = std::max(largest, std::abs(a[k] - b[k]));
      scale = std::max(scale, std::abs(a[k]));
    }
    return largest == 0 ? 0. : largest / scale;
  }
} // namespace vibrocontact
