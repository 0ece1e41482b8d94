#pragma once

#include <vibrocontact/run/prepare_bodies.h>

namespace vibrocontact
{
  /// What sections Transient and Rolling ask for together and of the bodies, before anything is made.
  /// @throws InputError
  void check_transient(const Parameters &parameters);

  /// Whether the transient moves contact points with mass: finite elements other than those of a bar with a massless contact
  /// node.
  bool contact_points_have_mass(const Parameters &parameters);

  /// What has to be read or made to be checked, but takes no time: expressions and tables of the drive
  /// (check_drive()), and the name of the perturbed mode if the modes of its body are in the cache.
  /// Collective.
  /// @throws InputError
  void check_transient_files(const Parameters &parameters, const MeshedBodies &bodies);
} // namespace vibrocontact
