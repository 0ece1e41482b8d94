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

  /// What a surface that is round along x adds to the half-space's answer to these waves, of first order in 1 / (k R): body 1 is
  /// above it, a cylinder of radius R along y as far as waves above K see. The surface impedance Z(r; n, q) of motions
  /// e^{i(n theta + q y)} obeys a Riccati equation in the radius,
  ///
  ///   dZ/dr + Z / r = -(Z - B^H) A^-1 (Z - B) + D,        traction = A du/dr + B u
  ///
  /// Z = Z_0(s, q) + Z_1(s, q) / r with s = n / r leaves a Lyapunov equation for Z_1, and the compliance C_1 = -Z_0^-1 Z_1 Z_0^-1 / R.
  /// With k^2 = s^2 + q^2, w = s^2 / k^2 and G the shear modulus, along normal (r), x and y:
  ///
  ///   C_rr = (1 - 2 nu) ((1 - nu) - (3/2 - nu) w) / (G R k^2)
  ///   C_xx = (3/2 - (5/2 + 2 nu - 2 nu^2) w + b w^2) / (G R k^2)             b = 1/2 + 3 nu - 2 nu^2
  ///   C_yy = ((1 - 2 nu)^2 / 2 + (5 nu - 4 nu^2) w - b w^2) / (G R k^2)
  ///   C_xy = s q (-1 - 2 nu + 2 nu^2 + b w) / (G R k^4)
  ///   C_rx = i s (-1/2 - 5 nu/2 + 2 nu^2 + d w) / (G R k^3)                  d = -1/2 + 7 nu/2 - 2 nu^2
  ///   C_ry = i q (1/2 - 5 nu/2 + 2 nu^2 + d w) / (G R k^3)
  ///
  /// Along y they are transformed back in closed form, along x by quadrature.
  /// @param radius R [m] @return rows as above, normals those of the surface; no longer positive by itself
  DenseMatrix short_wave_curvature(const ContactGrid &grid, const HalfSpaceMaterial &material, double radius,
                                   double wave_number);
} // namespace vibrocontact
