#pragma once

#include <vibrocontact/run/parameters.h>

namespace vibrocontact
{
  /// @throws InputError for scenes that limit cycles do not take
  void check_limit_cycle(const Parameters &parameters);
} // namespace vibrocontact
