#pragma once

#include <vibrocontact/coupled_bodies/contact_pair.h>
#include <vibrocontact/coupled_bodies/quasi_static_rolling.h>

#include <functional>

namespace vibrocontact
{
  /// Bodies brought together: the geometry of their contacts and the operator of steady rolling.
  struct RollingScene
  {
    ContactInterface interface;
    /// the contact operator y = A R for a rolling speed [m/s]
    std::function<std::shared_ptr<const ContactOperator>(double speed)> operator_at;
  };

  /// Joins bodies, each a half-space, rigid or reduced, body 1 being moved by its hub. Two half-spaces keep their
  /// fast operator; otherwise the compliances are added, a meshed body's being that of its own elements only.
  /// @throws InputError if a body that is free to move is loaded
  RollingScene rolling_scene(const std::vector<ContactBody> &bodies, const ContactSections &sections,
                             const PlacedContacts &contacts);
  /// Two bodies in one contact.
  inline RollingScene rolling_scene(const ContactBody &body_1, const ContactBody &body_2,
                                    const ContactParameters &contact, const ContactGrid &grid)
  {
    return rolling_scene({body_1, body_2}, contact, grid);
  }
} // namespace vibrocontact
