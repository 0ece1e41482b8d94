#pragma once

#include <vibrocontact/bodies/body_in_contact.h>
#include <vibrocontact/reduction/reduced_body.h>

namespace vibrocontact
{
  /// A reduced body on a road: rows of all points upward, with friction then those forward.
  /// @param forward sign of the body's x along the road: the contact's x points backwards, a ring's forward
  BodyInContact road_rows(const ReducedBody &body, bool with_friction, double forward);
} // namespace vibrocontact
