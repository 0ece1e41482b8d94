#pragma once

#include <vibrocontact/contact/placed_contacts.h>

#include <array>
#include <vector>

namespace vibrocontact
{
  /// Where the bodies of a scene lie beside each other: the origin of each one's own coordinates in those of body 1, so that the
  /// nominal points of each contact meet; 0 for one that no contact leads to [m]. Pictures and fields are written with it.
  /// @param n_bodies of the scene, or fewer: at least those of the contacts are found
  std::vector<std::array<double, 3>> places_of_bodies(const PlacedContacts &contacts,
                                                      unsigned int n_bodies = 0);
} // namespace vibrocontact
