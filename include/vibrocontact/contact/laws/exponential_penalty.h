#pragma once

#include <vibrocontact/contact/laws/normal_law.h>

namespace vibrocontact
{
  /// Exponential penalty of the axial-bar paper: N = f(g) = a (exp(alpha d) - 1), d = max(-g, 0)  (Jones & Legrand 2014).
  /// Numbers: amplitude a [N], exponent alpha [1/m], both positive.
  ///
  /// Graph: zero for open gaps, then a curve that leaves the origin with slope a alpha. Beyond alpha d = 2 it is continued
  /// linearly, so that a wild iterate cannot overflow. It tends to Signorini as a grows, the penetration being
  /// N / (a alpha) to first order. A plain N' = f(g) would satisfy the same law as its resolvent, but a fixed point on it
  /// diverges once the law is stiffer than the bodies.
  NormalLawEntry exponential_penalty();

  /// Contact/Penalty amplitude and Penalty exponent.
  std::vector<LawParameter> penalty_parameters();
} // namespace vibrocontact
