#pragma once

#include <vibrocontact/contact/laws/friction_law.h>

namespace vibrocontact
{
  /// mu over the slip speed by points: monotone cubics through them, constant beyond the last. Numbers: speed [m/s] and mu
  /// of each point, from speed 0 on.
  ///
  /// Two points at speed 0 are a jump: the first is the coefficient at rest, the second that of the slowest sliding. A value
  /// at rest below that of sliding changes nothing: between the two the point rests as well.
  FrictionLawEntry friction_curve();
} // namespace vibrocontact
