#pragma once

#include <vibrocontact/analyses/contact_pair.h>
#include <vibrocontact/analyses/quasi_static_rolling.h>

#include <functional>

namespace vibrocontact
{
  /// Two bodies brought together: the geometry of their contact and the operator of steady rolling.
  struct RollingScene
  {
    ContactInterface interface;
    /// the contact operator y = A R for a rolling speed [m/s]
    std::function<std::shared_ptr<const ContactOperator>(double speed)> operator_at;
  };

  /// Pairs body 1 (above) and body 2 (below), each a half-space or a reduced body. Two half-spaces keep their
  /// fast operator; otherwise the compliances are added, a meshed body's being that of its own elements only.
  /// @throws InputError if a body that is free to move is loaded
  RollingScene rolling_scene(const ContactBody &body_1, const ContactBody &body_2,
                             const ContactParameters &contact, const ContactGrid &grid);
} // namespace vibrocontact
