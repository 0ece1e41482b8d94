#pragma once

#include <vibrocontact/run/parameters.h>

namespace vibrocontact
{
  /// The entries of a periodic motion against its bodies, contacts and laws. @throws InputError
  void check_periodic(const Parameters &parameters);
} // namespace vibrocontact
