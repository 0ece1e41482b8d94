#pragma once

#include <cstddef>

namespace vibrocontact
{
  /// sum over k < n of c_k x^k: Horner's rule in x^4 on every fourth coefficient, so that four sums run at once.
  inline double polynomial(const double *c, const std::size_t n, const double x)
  {
    const double square = x * x, fourth = square * square;
    double s[4] = {0, 0, 0, 0};
    std::size_t k = n / 4 * 4;
    for (std::size_t j = 0; j < n - k; ++j)
      s[j] = c[k + j];
    while (k > 0)
    {
      k -= 4;
      for (unsigned int j = 0; j < 4; ++j)
        s[j] = s[j] * fourth + c[k + j];
    }
    return (s[0] + x * s[1]) + square * (s[2] + x * s[3]);
  }

  /// its derivative
  inline double polynomial_slope(const double *c, const std::size_t n, const double x)
  {
    double result = 0;
    for (std::size_t k = n; k-- > 1;)
      result = result * x + k * c[k];
    return result;
  }
} // namespace vibrocontact
