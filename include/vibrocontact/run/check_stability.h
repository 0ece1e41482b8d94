#pragma once

#include <vibrocontact/run/parameters.h>

namespace vibrocontact
{
  /// What section Stability asks for of itself and of the bodies, before anything is made. @throws InputError
  void check_stability(const Parameters &parameters);
} // namespace vibrocontact
