#pragma once

#include <cmath>
#include <complex>
#include <vector>

namespace vibrocontact
{
  /// lambda of the one oscillation that dominates equally spaced samples: x_{k+1} = a x_k + b x_{k-1} by
  /// least squares
  inline std::complex<double> fit_one_oscillation(std::vector<double> x, const double spacing)
  {
    // differences leave slow motions behind
    for (unsigned int k = 0; k + 1 < x.size(); ++k)
      x[k] = x[k + 1] - x[k];
    x.pop_back();
    double xx = 0, xy = 0, yy = 0, xz = 0, yz = 0;
    for (unsigned int k = 1; k + 1 < x.size(); ++k)
    {
      xx += x[k] * x[k];
      xy += x[k] * x[k - 1];
      yy += x[k - 1] * x[k - 1];
      xz += x[k] * x[k + 1];
      yz += x[k - 1] * x[k + 1];
    }
    const double det = xx * yy - xy * xy, a = (xz * yy - yz * xy) / det, b = (yz * xx - xz * xy) / det;
    const std::complex<double> root = (a + std::sqrt(std::complex<double>(a * a + 4 * b))) / 2.;
    return std::log(root) / spacing;
  }
} // namespace vibrocontact
