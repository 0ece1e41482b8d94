#pragma once

#include <vibrocontact/contact/laws/friction_law.h>

namespace vibrocontact
{
  /// Friction that falls with the slip speed (Stribeck's curve without its viscous branch), or rises:
  ///
  ///   mu(s) = mu_k (1 + (ratio - 1) exp(-s / v)),     ratio = mu_s / mu_k,     s = |slip| [m/s]
  ///
  /// Numbers: mu_k, ratio, v. Graph: from mu_s at rest to mu_k, by 63 % of the way at s = v; down for ratio > 1, up for
  /// ratio < 1. Tangent: dmu/ds = -(mu_s - mu_k) / v exp(-s / v), a damping N dmu/ds along the slip, negative if falling: a
  /// mass m that slides under the force N gains -N (dmu/ds) / (2 m) of growth rate, under rising friction it loses it.
  FrictionLawEntry falling_friction();
} // namespace vibrocontact
