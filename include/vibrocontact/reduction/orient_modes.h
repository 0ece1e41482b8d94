#pragma once

#include <vibrocontact/reduction/modes.h>

namespace vibrocontact
{
  /// Turns nearly equal pairs and fixes signs, in place; see compute_modes().
  void orient_modes(const SecondOrderSystem &system, Modes &modes);
} // namespace vibrocontact
