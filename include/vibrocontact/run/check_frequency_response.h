#pragma once

#include <vibrocontact/run/parameters.h>

namespace vibrocontact
{
  /// The entries of frequency responses against the bodies that are asked for. @throws InputError
  void check_frequency_response(const Parameters &parameters);
} // namespace vibrocontact
