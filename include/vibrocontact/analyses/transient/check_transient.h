#pragma once

#include <vibrocontact/analyses/transient/transient_parameters.h>
#include <vibrocontact/coupled_bodies/quasi_static_rolling.h>
#include <vibrocontact/scene/scene.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// What sections Transient and Rolling ask for together and of the bodies, before anything is made.
  /// @param with_modes names of the bodies that have modes
  /// @throws InputError
  void check_transient(const TransientParameters &transient, const RollingParameters &rolling,
                       const Scene &scene, const std::vector<std::string> &with_modes);

  /// Whether the transient moves contact points with mass: finite elements other than those of a bar with a massless contact
  /// node.
  bool contact_points_have_mass(const TransientParameters &transient, const Scene &scene);
} // namespace vibrocontact
