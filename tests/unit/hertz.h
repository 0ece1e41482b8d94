// Hertz's theory, a truth of the tests.
#pragma once

#include "pi.h"

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_2.hpp>
#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>

/// Hertz's elliptical contact of two surfaces with gap = A x^2 + B y^2 (Johnson 1985, ch. 4).
struct HertzContact
{
  /// half axes along x and y [m], largest pressure [Pa], approach [m]
  double semi_axis_x, semi_axis_y, max_pressure, approach;
};

/// @param curvature_x A [1/m] > 0, @param curvature_y B [1/m] > 0, @param force normal force [N] > 0
inline HertzContact hertz_contact(const double curvature_x, const double curvature_y,
                                  const double inverse_contact_modulus, const double force)
{
  // kappa = minor / major half axis; the major one lies along the smaller curvature. With e^2 = 1 - kappa^2
  //   B / A = [E(e) / kappa^2 - K(e)] / [K(e) - E(e)],   p0 = (A + B) b E* / E(e),   p0 = 3 F / (2 pi a b)
  const double small = std::min(curvature_x, curvature_y), large = std::max(curvature_x, curvature_y);
  const auto mismatch = [&](const double kappa)
  {
    const double e = std::sqrt(1 - kappa * kappa);
    const double K = boost::math::ellint_1(e), E = boost::math::ellint_2(e);
    return (E / (kappa * kappa) - K) - large / small * (K - E);
  };
  double kappa = 1;
  if (large / small > 1 + 1e-8)
  {
    boost::uintmax_t iterations = 200;
    const auto bracket = boost::math::tools::toms748_solve(
        mismatch, 1e-6, 1 - 1e-10, boost::math::tools::eps_tolerance<double>(48), iterations);
    kappa = 0.5 * (bracket.first + bracket.second);
  }
  const double e = std::sqrt(1 - kappa * kappa);
  const double K = boost::math::ellint_1(e), E = boost::math::ellint_2(e);
  const double minor = std::cbrt(1.5 * force * inverse_contact_modulus * kappa * E / (pi * (small + large)));
  const double major = minor / kappa;
  HertzContact hertz;
  hertz.semi_axis_x = curvature_x <= curvature_y ? major : minor;
  hertz.semi_axis_y = curvature_x <= curvature_y ? minor : major;
  hertz.max_pressure = 1.5 * force / (pi * major * minor);
  hertz.approach = hertz.max_pressure * inverse_contact_modulus * minor * K;
  return hertz;
}
