#pragma once

#include <vibrocontact/contact/laws/normal_law.h>

namespace vibrocontact
{
  /// Signorini: g >= 0, N >= 0, g N = 0  <=>  N = max(N - rho g, 0).
  ///
  /// Graph: the corner of the two half-axes. It has no stiffness of its own.
  NormalLawEntry signorini();
} // namespace vibrocontact
