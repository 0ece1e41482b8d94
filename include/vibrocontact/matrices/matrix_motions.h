#pragma once

#include <vibrocontact/fe/second_order_system.h>

#include <vector>

namespace vibrocontact
{
  /// Motions without energy among the six of a rigid body that places and directions of the dofs make: combinations v with
  /// |K v| below 1e-10 of the sum of its parts, row by row in the mean. A body that only slides or turns about an axis has
  /// fewer than six. Orthonormal. Collective. @param size largest distance of a dof from the origin [m]
  std::vector<dealii::PETScWrappers::MPI::Vector>
  rigid_motions_by_places(const SecondOrderSystem &system, const std::vector<bool> &held, double size);

  /// Null space of K of a reduced body, whose coordinates need not have a place, by LAPACK: roots below 1e-10 of the largest,
  /// each coordinate measured by its own stiffness. Orthonormal. Collective.
  /// @throws InputError for more than six, or more coordinates than go to LAPACK
  std::vector<dealii::PETScWrappers::MPI::Vector> null_motions(const SecondOrderSystem &system);

  /// t^T M t of the unit translation t along that axis of x, y, z which gives most [kg]
  double mass_along_axes(const SecondOrderSystem &system);
} // namespace vibrocontact
