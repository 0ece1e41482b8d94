#pragma once

#include <vibrocontact/bodies/body_in_contact.h>
#include <vibrocontact/bodies/reduced_body.h>

namespace vibrocontact
{
  /// A reduced body on a road: rows of all points upward, with friction then those forward.
  /// @param forward sign of the body's x along the road: the contact's x points backwards, a ring's forward
  BodyInContact road_rows(const ReducedBody &body, bool with_friction, double forward);

  /// The other way round: a body on a road with the rows of a contact. Its x points backwards, as in all rolling contacts;
  /// what the body has no rows for, across the road and along it without friction, does not give way. A hub that moves down
  /// takes all points with it.
  /// @param heights of the undeformed surface at the points, from the last to the first [m]; n
  ReducedBody contact_rows(const BodyInContact &body, const std::string &name, const ContactGrid &grid,
                           const std::vector<double> &heights);
} // namespace vibrocontact
