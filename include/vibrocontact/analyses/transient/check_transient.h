#pragma once

#include <vibrocontact/run/parameters.h>

namespace vibrocontact
{
  /// What sections Transient and Rolling ask for together and of the bodies, before anything is made.
  /// @throws InputError
  void check_transient(const Parameters &parameters);

  /// Whether the transient moves contact points with mass: finite elements other than those of a bar with a massless contact
  /// node, or bodies all of whose flexibility has mass (an oscillator) where nothing else yields.
  bool contact_points_have_mass(const Parameters &parameters);
} // namespace vibrocontact
