#pragma once

#include <vibrocontact/contact/laws/friction_law.h>

namespace vibrocontact
{
  /// Coulomb: the same mu at rest and at every slip speed. Numbers: mu.
  FrictionLawEntry coulomb();
} // namespace vibrocontact
