#pragma once

#include <vibrocontact/fe/contact_trace.h>
#include <vibrocontact/fe/elastic_body.h>
#include <vibrocontact/scene/contact_frame.h>

namespace vibrocontact
{
  /// Build P_c of a meshed body on a contact grid, whatever its nodes are.
  ///
  /// Every contact cell is cut into 2 by 2 sub-cells (more if the faces are smaller, 10 by 10 if faces end
  /// inside them) with Gauss points of their own. For each point (x, y) the contact face below or above it is
  /// found (Newton on the face's polynomial map, nearest to z = 0) and the shape functions are evaluated
  /// there. The integral is exact if face edges lie on sub-cell edges, as with 2 mm cells and a 1 mm grid
  /// with a node on the contact point; otherwise a uniform pressure is uneven by some 0.1 %. In 2d the
  /// contact is the x axis (n_y = 1) and the rows of the lateral component stay empty. Hanging nodes are
  /// replaced by the nodes that carry them.
  ///
  /// @throws InputError if the grid leaves the contact surface, is finer than the nodes of the mesh (spacing
  ///   below cell size over degree), or touches held nodes. Collective: all ranks throw.
  /// @param frame where the grid lies on a body of three dimensions
  template <int dim>
  ContactTrace make_contact_trace(const ElasticBody<dim> &body, const ContactGrid &grid,
                                  const ContactFrame &frame = {});
} // namespace vibrocontact
