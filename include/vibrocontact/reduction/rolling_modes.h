#pragma once

#include <vibrocontact/bodies/body_in_contact.h>
#include <vibrocontact/reduction/flow_reduction.h>

namespace vibrocontact
{
  /// A body of revolution that rolls, in the modes q of the same body at rest (fe/material_flow.h). Rows and forces stand
  /// still in the frame of the road while the material turns past them with Omega:
  ///
  ///   q'' + 2 Omega G q' + 2 diag(zeta w) (q' + Omega G_turning q) + diag(w^2) q = trace^T f + modal_load
  ///
  /// Damping acts on what the material sees of its deformation, the rate in place and what flows past. All else of second
  /// order in Omega cancels. With y = (q, q') this is y' = A y + (0, f), whose eigenvectors are the right shapes of the
  /// poles, and those of A^T the left ones. Modes of different orders have nothing in common, so that A falls into small
  /// blocks.
  ///
  /// The rest, what the modes leave out, is that at rest: Coriolis's forces are zero in what stands still, and of its damping
  /// is missing 2 zeta n Omega / w of each order n (doc/theory.md, "A rolling ring by elements").
  ///
  /// @param at_rest by modes @param rotation Omega towards growing theta [rad/s]
  /// @return by poles, named by order and branch; tangential rows of `gradient` follow if there are 2 n rows for the n of the
  /// flow: the stretch of the modes. `residual_gradient` is left to the caller.
  /// @throws InputError if a motion grows
  BodyInContact rolling_modes(const BodyInContact &at_rest, const FlowReduction &flow, double rotation);
} // namespace vibrocontact
