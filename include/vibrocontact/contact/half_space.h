#pragma once

#include <array>

namespace vibrocontact
{
  /// Elastic constants of a half-space.
  struct HalfSpaceMaterial
  {
    /// E [Pa], nu [-]
    double young_modulus, poisson_ratio;
    double shear_modulus() const { return young_modulus / (2 * (1 + poisson_ratio)); }
  };

  /// Surface displacement jump (body 1 minus body 2) of two elastic half-spaces in contact along z = 0.
  ///
  /// Boussinesq and Cerruti (Johnson, Contact mechanics, 1985, ch. 3), integrated over a rectangle of
  /// constant traction (Love 1929). With r the distance, body 1 above (z up), force (N, Tx, Ty) on body 1 and
  /// its opposite on body 2, the point-load jump is
  ///
  ///   du_z = a N / r + c (x Tx + y Ty) / r^2
  ///   du_x = -c x N / r^2 + (a / r + b x^2 / r^3) Tx + b x y / r^3 Ty          (du_y likewise)
  ///
  ///   a = sum (1 - nu) / (2 pi G),  b = sum nu / (2 pi G)  over the two bodies,
  ///   c = (1 - 2 nu_1) / (4 pi G_1) - (1 - 2 nu_2) / (4 pi G_2),  zero for equal materials.
  class HalfSpacePair
  {
  public:
    /// A rigid body is given by an infinite Young modulus. Without coupling c is left out: normal forces move
    /// nothing tangentially and tangential ones nothing normally (Kalker's and Pieringer's simplification).
    HalfSpacePair(const HalfSpaceMaterial &body_1, const HalfSpaceMaterial &body_2, bool coupling = true);

    /// Jump at (x, y) from unit forces spread over the rectangle size_x * size_y centred at the origin:
    /// matrix [displacement component][force component], components normal, x, y [m/N]. Symmetric under
    /// exchange of the two points.
    std::array<std::array<double, 3>, 3> influence(double x, double y, double size_x, double size_y) const;

    /// a, b, c [m^2/N]
    std::array<double, 3> constants() const { return {{a, b, c}}; }
    /// 1 / E* = sum (1 - nu^2) / E [1/Pa]
    double inverse_contact_modulus() const { return inverse_modulus; }

  private:
    double a, b, c, inverse_modulus;
  };
} // namespace vibrocontact
