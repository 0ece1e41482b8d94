#pragma once

#include <vibrocontact/bodies/reduced_body.h>

#include <vector>

namespace vibrocontact
{
  /// The grid that holds `grid` in every position from `first` to `last`, its origin moved along y [m].
  ///
  ///      y ^   . . . . .  -+-            Reduced once on the band, a body is known in each of the
  ///        |   . . . . .   |  window     positions by the rows of its window: the mesh is fine along
  ///        |   . . . . .  -+-   |        the whole band, the spacing that of the window.
  ///        |   . . . . .       -+-
  ///        +-> . . . . .   x
  ///
  /// @throws InputError if a position is no multiple of the grid's spacing
  ContactGrid band(const ContactGrid &grid, double first, double last);

  /// The grid without the rows whose cells reach below `low` or beyond `high` along y [m].
  ContactGrid clipped(const ContactGrid &grid, double low, double high);

  /// Rows of the contact points of `grid` among those of `whole`, as contact_row(); where its origin lies as in window().
  std::vector<unsigned int> window_rows(const ContactGrid &whole, const ContactGrid &grid,
                                        double lateral = 0);

  /// The body with the contact points of `grid` alone, whose origin lies at `lateral` along y and `height`
  /// along z in the frame of the body's own grid [m]: rows of traces, flexibility, lifting and load response,
  /// and the surface's height from there. Modes and poles with their loads stay as they are.
  ReducedBody window(const ReducedBody &body, const ContactGrid &grid, double lateral, double height = 0);
} // namespace vibrocontact
