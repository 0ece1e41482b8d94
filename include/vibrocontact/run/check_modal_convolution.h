#pragma once

#include <vibrocontact/run/parameters.h>

namespace vibrocontact
{
  /// What sections Modal convolution, Road and Comparison ask for together and of the bodies, before anything is made.
  /// @throws InputError
  void check_modal_convolution(const Parameters &parameters);
} // namespace vibrocontact
