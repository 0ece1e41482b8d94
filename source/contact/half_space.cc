#include <vibrocontact/contact/half_space.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// log(x + r), r^2 = x^2 + y^2, without the cancellation for negative x
    double log_sum(const double x, const double y, const double r)
    {
      return x >= 0 ? std::log(x + r) : 2 * std::log(std::abs(y)) - std::log(r - x);
    }

    /// Means over a rectangle of what a point load's displacements are made of.
    struct Means
    {
      /// x^2 / r^3, x y / r^3, y^2 / r^3; x / r^2, y / r^2 [1/m]
      double xx = 0, xy = 0, yy = 0, x_r2 = 0, y_r2 = 0;
    };

    /// Primitives, summed with alternating sign over the corners (X, Y) of the rectangle seen from the point:
    ///   1 / r: X log(Y + r) + Y log(X + r)      X^2 / r^3: Y log(X + r)      X Y / r^3: -r
    ///   X / r^2: Y log(r) + X atan(Y / X)       and the same with X and Y exchanged
    Means closed_form(const double x, const double y, const double size_x, const double size_y)
    {
      Means mean;
      for (const int sx : {-1, 1})
        for (const int sy : {-1, 1})
        {
          const double X = x + 0.5 * sx * size_x, Y = y + 0.5 * sy * size_y, r = std::hypot(X, Y);
          if (r == 0)
            continue;
          const double sign = sx * sy / (size_x * size_y), log_r = std::log(r);
          mean.xx += Y == 0 ? 0 : sign * Y * log_sum(X, Y, r);
          mean.yy += X == 0 ? 0 : sign * X * log_sum(Y, X, r);
          mean.xy -= sign * r;
          mean.x_r2 += sign * (Y * log_r + (X == 0 ? 0 : X * std::atan(Y / X)));
          mean.y_r2 += sign * (X * log_r + (Y == 0 ? 0 : Y * std::atan(X / Y)));
        }
      return mean;
    }

    /// f + (size_x^2 f_xx + size_y^2 f_yy) / 24 + O(size / r)^4
    Means far_away(const double x, const double y, const double size_x, const double size_y)
    {
      const double r = std::hypot(x, y), c = x / r, s = y / r, p = size_x * size_x / (24 * r * r),
                   q = size_y * size_y / (24 * r * r), cc = c * c, ss = s * s;
      Means mean;
      mean.xx = (cc + p * (2 - 15 * cc + 15 * cc * cc) + q * cc * (15 * ss - 3)) / r;
      mean.yy = (ss + q * (2 - 15 * ss + 15 * ss * ss) + p * ss * (15 * cc - 3)) / r;
      mean.xy = c * s * (1 + p * (15 * cc - 9) + q * (15 * ss - 9)) / r;
      mean.x_r2 = c * (1 + (p - q) * (8 * cc - 6)) / r;
      mean.y_r2 = s * (1 + (q - p) * (8 * ss - 6)) / r;
      return mean;
    }

    /// Distance over size where both are right to 1e-11: the closed form's corners cancel as the square of it.
    constexpr double far = 400;
  } // namespace

  HalfSpacePair::HalfSpacePair(const HalfSpaceMaterial &body_1, const HalfSpaceMaterial &body_2,
                               const bool coupling)
      : a(0), b(0), c(0), inverse_modulus(0)
  {
    double sign = 1;
    for (const HalfSpaceMaterial *body : {&body_1, &body_2})
    {
      const double nu = body->poisson_ratio,
                   compliance = 1 / (2 * dealii::numbers::PI * body->shear_modulus());
      a += (1 - nu) * compliance;
      b += nu * compliance;
      c += coupling ? sign * 0.5 * (1 - 2 * nu) * compliance : 0.;
      inverse_modulus += (1 - nu * nu) / body->young_modulus;
      sign = -1;
    }
  }

  std::array<std::array<double, 3>, 3>
  HalfSpacePair::influence(const double x, const double y, const double size_x, const double size_y) const
  {
    const Means mean = std::hypot(x, y) > far * std::max(size_x, size_y) ? far_away(x, y, size_x, size_y)
                                                                         : closed_form(x, y, size_x, size_y);
    const double normal = a * (mean.xx + mean.yy), coupling_x = c * mean.x_r2, coupling_y = c * mean.y_r2;
    return {{{{normal, coupling_x, coupling_y}},
             {{-coupling_x, normal + b * mean.xx, b * mean.xy}},
             {{-coupling_y, b * mean.xy, normal + b * mean.yy}}}};
  }
} // namespace vibrocontact
