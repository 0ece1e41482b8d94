#pragma once

#include <vibrocontact/coupled_bodies/contact_pair.h>

namespace vibrocontact
{
  /// @throws InputError if body 1 of a scene does not follow its hub as a whole, so that this cannot press it
  void check_pressed_by_hub(const ContactBody &body_1, const PlacedContacts &contacts);
} // namespace vibrocontact
