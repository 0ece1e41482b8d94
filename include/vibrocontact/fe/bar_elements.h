#pragma once

#include <vibrocontact/fe/second_order_system.h>
#include <vibrocontact/scene/bar.h>
#include <vibrocontact/scene/material.h>

#include <memory>

namespace vibrocontact
{
  /// Finite elements of a bar (FE_Q<1>, consistent mass): M_ab = int rho S N_a N_b dz, K_ab = int E S N_a'
  /// N_b' dz; one dof per node, along z. The trace holds the displacement of the contact end in its normal
  /// row and nothing in the tangential ones.
  ///
  /// @param above whether the bar stands above the plane z = 0 (body 1) or below it (body 2)
  /// @param grid one contact point, or null without contact; @param gravity acceleration along -z [m/s^2]
  std::unique_ptr<SecondOrderSystem> assemble_bar(const BarParameters &bar, const ElasticMaterial &material,
                                                  const std::string &name, bool above,
                                                  const ContactGrid *grid, MPI_Comm communicator,
                                                  double gravity = 0);
} // namespace vibrocontact
