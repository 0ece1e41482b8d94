#pragma once

#include <vibrocontact/contact/laws/friction_laws.h>
#include <vibrocontact/contact/laws/normal_laws.h>

namespace vibrocontact
{
  /// The laws that a program knows; by default the shipped ones.
  struct ContactLaws
  {
    std::vector<NormalLawEntry> normal = normal_laws();
    std::vector<FrictionLawEntry> friction = friction_laws();
  };
} // namespace vibrocontact
