#pragma once

#include <vibrocontact/base/dense.h>
#include <vibrocontact/contact/half_space.h>
#include <vibrocontact/scene/contact_grid.h>

namespace vibrocontact
{
  /// What two half-spaces add to bodies whose flexibility is known for long waves alone: mean displacement of a cell under
  /// the mean traction of another one, the part of it that varies along x with wave numbers above K,
  ///
  ///   C - 1 / (2 pi) int_-K^K  e^{i k X} sinc^2(k dx / 2)  [mean over both cells along y of g(k, y)]  dk
  ///
  /// with g the Fourier transform along x of HalfSpacePair's kernels, which Bessel's K_0 and K_1 are:
  ///
  ///   1/r: 2 K_0(|k y|)      y^2/r^3: 2 |k y| K_1(|k y|)      x^2/r^3: the difference
  ///   x y/r^3: -2 i k y K_0(|k y|)      x/r^2: -i pi sgn(k) e^-|k y|      y/r^2: pi sgn(y) e^-|k y|
  ///
  /// @param wave_number K [1/m]; 0: all of it
  /// @return 3 n square, rows as contact_row() [m/N]; symmetric positive semi-definite
  DenseMatrix short_wave_compliance(const ContactGrid &grid, const HalfSpacePair &pair, double wave_number);
} // namespace vibrocontact
