#pragma once

#include <vibrocontact/coupled_bodies/contact_pair.h>
#include <vibrocontact/coupled_bodies/quasi_static_loading.h>

namespace vibrocontact
{
  /// Joins bodies, each a half-space, rigid or reduced, body 1 being moved by its hub. Two half-spaces keep their fast
  /// operator; otherwise compliances are added, a meshed body's being that of its own elements only.
  ///
  /// The coarse grid has twice the spacing: of two half-spaces it is made anew, of others it has CoarsePoints. There is none
  /// for single points.
  /// @throws InputError if a body that is free to move is loaded
  LoadingGrids loading_grids(const std::vector<ContactBody> &bodies, const ContactSections &sections,
                             const PlacedContacts &contacts);
} // namespace vibrocontact
