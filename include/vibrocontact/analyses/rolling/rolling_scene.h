#pragma once

#include <vibrocontact/coupled_bodies/contact_pair.h>
#include <vibrocontact/coupled_bodies/quasi_static_rolling.h>

namespace vibrocontact
{
  /// Joins bodies, each a half-space, rigid or reduced, body 1 being moved by its hub. Two half-spaces keep their
  /// fast operator; otherwise the compliances are added, a meshed body's being that of its own elements only.
  ///
  /// The coarse grid has twice the spacing: of two half-spaces it is made anew, of others it has CoarsePoints. There is none
  /// for single points.
  /// @param two of two half-spaces: the coarse grid is that of the contacts, and results are extrapolated
  /// @throws InputError if a body that is free to move is loaded
  RollingGrids rolling_grids(const std::vector<ContactBody> &bodies, const ContactSections &sections,
                             const PlacedContacts &contacts, bool two = false);
  /// Two bodies in one contact, on one grid.
  inline RollingGrid rolling_grid(const ContactBody &body_1, const ContactBody &body_2,
                                  const ContactParameters &contact, const ContactGrid &grid)
  {
    return rolling_grids({body_1, body_2}, contact, grid).own;
  }
} // namespace vibrocontact
