#pragma once

#include <vibrocontact/fe/second_order_system.h>

#include <deal.II/base/point.h>

#include <string>

namespace vibrocontact
{
  /// The dof of a body next to a place that moves in one direction (0 x, 1 y, 2 z); of several at the same distance the one of
  /// lowest number, the same on any number of ranks. Its distance goes to the log. Collective.
  /// @param what entry and name of the point, for messages
  /// @throws InputError if the place is further away than a twentieth of the body's size
  TraceRow nearest_dof(const SecondOrderSystem &system, const dealii::Point<3> &place, unsigned int direction,
                       const std::string &what);
} // namespace vibrocontact
