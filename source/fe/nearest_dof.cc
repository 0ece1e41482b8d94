#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/fe/nearest_dof.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <optional>

namespace vibrocontact
{
  namespace
  {
    /// Of a body whose coordinates are no displacements: the nearest point of what is known of it; nothing: none
    /// of them moves in this direction. The same on all ranks.
    std::optional<TraceRow> nearest_on_surface(const SurfaceTrace &surface, const dealii::Point<3> &place,
                                               const unsigned int direction, const std::string &what)
    {
      double distance = 1e300, size = 0;
      unsigned int point = 0;
      for (unsigned int i = 0; i < surface.points.size(); ++i)
      {
        size = std::max(size, surface.points[i].norm());
        if (!surface.rows[3 * i + direction].empty() && surface.points[i].distance(place) < distance)
        {
          distance = surface.points[i].distance(place);
          point = i;
        }
      }
      if (distance > 1e299)
        return {};
      if (distance > 0.05 * size)
        throw InputError(
            what + " is " + number_text(distance) +
            " m away from the nearest node that moves in its direction; give a place on the body.");
      run_log().line(what + ": nearest node " + number_text(1e3 * distance) + " mm away");
      return surface.rows[3 * point + direction];
    }
  } // namespace

  TraceRow nearest_dof(const SecondOrderSystem &system, const dealii::Point<3> &place,
                       const unsigned int direction, const std::string &what)
  {
    double distance = 1e300, size = 0;
    dealii::types::global_dof_index dof = 0;
    for (unsigned int i = 0; i < system.dof_position.size(); ++i)
    {
      size = std::max(size, system.dof_position[i].norm());
      if (system.dof_direction[i] == direction && system.dof_position[i].distance(place) < distance)
      {
        distance = system.dof_position[i].distance(place);
        dof = system.locally_owned.nth_index_in_set(i);
      }
    }
    const double smallest = dealii::Utilities::MPI::min(distance, system.communicator);
    size = dealii::Utilities::MPI::max(size, system.communicator);
    const bool is_here = distance < smallest * (1 + 1e-9) + 1e-12;
    dof = dealii::Utilities::MPI::min(is_here ? dof : system.stiffness.m(), system.communicator);
    if (smallest > 1e299)
      if (const auto row = nearest_on_surface(system.surface, place, direction, what + " of " + system.body))
        return *row;
    if (smallest > 1e299)
      throw InputError(what + ": no node of " + system.body + " moves along " + "xyz"[direction] +
                       "; give another direction.");
    if (smallest > 0.05 * size)
      throw InputError(what + " is " + number_text(smallest) + " m away from the nearest node of " +
                       system.body + " that moves in its direction; give a place on the body.");
    run_log().line(what + ": nearest node " + number_text(1e3 * smallest) + " mm away");
    return {{dof, 1.}};
  }
} // namespace vibrocontact
