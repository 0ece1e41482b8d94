#pragma once

#include <vibrocontact/run/parameters.h>

namespace vibrocontact
{
  /// What contacts of a list join and where, against the bodies of the scene and the analyses. @throws InputError
  void check_contacts(const Parameters &parameters);
} // namespace vibrocontact
