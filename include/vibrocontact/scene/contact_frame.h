#pragma once

#include <vibrocontact/scene/contact_grid.h>

#include <array>
#include <vector>

namespace vibrocontact
{
  /// Where a contact lies on a body, in the body's own coordinates: its nominal point and its directions.
  ///
  ///       normal ^   ^ y       the normal points from the second body of the contact to the first; x is the
  ///              |  /          direction of rolling (e_x) in the plane of contact, y = normal x x
  ///              | /
  ///       origin o-----> x     usual: origin 0, normal e_z
  struct ContactFrame
  {
    /// [m]
    std::array<double, 3> origin = {{0, 0, 0}};
    /// normal, x, y: in the order of contact_row()
    std::array<std::array<double, 3>, 3> axes = {{{{0, 0, 1}}, {{1, 0, 0}}, {{0, 1, 0}}}};

    bool has_usual_axes() const { return axes == ContactFrame().axes; }
    bool is_usual() const { return origin == ContactFrame().origin && has_usual_axes(); }
    /// Coordinates along x, y and normal of a place in the coordinates of the body [m].
    std::array<double, 3> coordinates(const std::array<double, 3> &place) const;
  };

  /// @throws InputError if the normal is zero or along x
  ContactFrame contact_frame(const std::array<double, 3> &origin, const std::array<double, 3> &normal);

  /// A contact as one of its bodies has it.
  struct ContactPlace
  {
    ContactGrid grid;
    ContactFrame frame;
    /// whether the body is the first of the contact, on the side that the normal points to
    bool above = true;
  };

  /// A grid in the usual frame that covers those of all places.
  ContactGrid covering_grid(const std::vector<ContactPlace> &places);
} // namespace vibrocontact
