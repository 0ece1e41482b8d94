#pragma once

#include <vibrocontact/contact/laws/normal_law.h>

namespace vibrocontact
{
  /// A spring N(gap) by points: monotone cubics through them, beyond the deepest one a straight line. Numbers: gap [m] and
  /// force [N] of each point; one is (0, 0), gaps are not positive, forces rise with the penetration.
  NormalLawEntry spring_curve();
} // namespace vibrocontact
