#pragma once

#include <vibrocontact/scene/contact_grid.h>

namespace vibrocontact
{
  /// Rectangle in the tangent plane that is all of a body's contact surface: a pad, a box [m].
  struct FlatFace
  {
    double x_low = 0, x_high = 0, y_low = 0, y_high = 0;
  };

  /// The grid without what lies beyond the edges of a flat face: where it reaches them it has as many cells as
  /// come nearest to its spacing, and ends with the face.
  /// @param at_rest along x too; what rolls needs open points upstream, where a face that ends has none
  ContactGrid fitted(const ContactGrid &grid, const FlatFace &face, bool at_rest);

  /// Sides on which a contact grid ends because a body's surface does, so that the contact may reach them.
  struct SurfaceEnds
  {
    bool upstream = false, downstream = false, low_y = false, high_y = false;

    /// Adds the sides that end with @p face.
    void add(const ContactGrid &grid, const FlatFace &face);
    bool all() const { return upstream && downstream && low_y && high_y; }
  };
} // namespace vibrocontact
