#pragma once

#include <vibrocontact/fe/second_order_system.h>
#include <vibrocontact/scene/ring.h>

#include <memory>
#include <string>

namespace vibrocontact
{
  /// The ring by finite elements, mass and stiffness of the one at rest; of one that rolls with its flow
  /// (fe/material_flow.h). Trace and frame: the ring's, scene/ring.h (x = R sin theta forward, z
  /// up from the bottom of the mean circle); normal rows are the motion inward, x rows that along theta, y rows
  /// are empty. Loss of 2 xi K, so that every mode has the damping ratio xi.
  ///
  /// Curved beam: w and v by cubic Hermite polynomials of theta on equal elements, so that the energy of
  /// scene/ring.h holds as it stands and turning as a whole is exact. Dofs of a node: displacements along x and
  /// z, slopes of v and w per element.
  std::unique_ptr<SecondOrderSystem> assemble_beam_ring(const RingParameters &ring, const std::string &name,
                                                        const ContactGrid *grid, MPI_Comm communicator);

  /// Plane solid, FE_Q(degree)^2 on an annulus, one element through the thickness: plane stress (Poisson's ratio
  /// 0, so that plane strain is the same) over the width. Springs and pressure act on the mean circle, the hoop
  /// stress sigma = p R / h through the thickness (u displacement, s length along theta):
  ///
  ///   2 E = ... + int sigma |du/ds|^2 dV + int k_z u_n^2 + k_theta u_t^2 - p b (u_x du_z/ds - u_z du_x/ds) ds
  ///
  /// the last term with a follower pressure only. Shear and rotary inertia make it softer than Euler and
  /// Bernoulli's ring. Forces spread evenly through the thickness, whose mean motion is the contact's: a force
  /// in a point would sink in without limit as elements get smaller. So is the stretch of a ring that rolls a mean.
  std::unique_ptr<SecondOrderSystem> assemble_solid_ring(const RingParameters &ring, const std::string &name,
                                                         const ContactGrid *grid, MPI_Comm communicator);

  /// By Model; not for the analytic one.
  std::unique_ptr<SecondOrderSystem> assemble_ring(const RingParameters &ring, const std::string &name,
                                                   const ContactGrid *grid, MPI_Comm communicator);
} // namespace vibrocontact
