#pragma once

#include <vibrocontact/run/parameters.h>

namespace vibrocontact
{
  /// What carries body 1, in the analyses in which it moves or is pressed down.
  /// @throws InputError
  void check_hub(const Parameters &parameters);
} // namespace vibrocontact
