#pragma once

#include <vibrocontact/contact/laws/normal_law.h>

namespace vibrocontact
{
  /// Signorini: g >= 0, N >= 0, g N = 0  <=>  N = max(N - rho g, 0).
  ///
  /// Graph: the corner of the two half-axes. It has no stiffness of its own.
  NormalLawEntry signorini();

  /// The projection on N >= 0. Of one point alone it is the solution in closed form: the force that would close its gap, 0 if
  /// that pulls.
  inline double rigid_force(const double trial)
  {
    return trial > 0 ? trial : 0.;
  }
} // namespace vibrocontact
