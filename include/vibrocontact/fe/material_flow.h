#pragma once

#include <vibrocontact/fe/trace_row.h>

#include <deal.II/lac/petsc_sparse_matrix.h>

#include <vector>

namespace vibrocontact
{
  /// What a body of revolution brings beside mass and stiffness if its material turns past places that stand still, at
  /// Omega towards growing theta. With D = d/dt + Omega d/dtheta of displacements u in the frame of the road, m D^2 u is
  ///
  ///   M U'' + 2 Omega G U' + Omega^2 (...)
  ///
  /// and the hoop tension by which the ring carries its own rotation, rho Omega^2 r^2 at the radius r, gives the last term
  /// once more, with the other sign: the stiffness is that at rest (doc/theory.md, "A rolling ring by elements").
  ///
  /// Of a body that is seen in axes that turn with it (fe/prestress.h) `fixed` alone, its Coriolis forces: nothing flows.
  struct MaterialFlow
  {
    /// G = int rho N_i . dN_j/dtheta dV, in axes that do not turn: what inertia feels; antisymmetric [kg]
    dealii::PETScWrappers::MPI::SparseMatrix fixed;
    /// the same of radial and circumferential components, which turn with theta: what the material feels of its own
    /// deformation, and its damping with it; antisymmetric [kg]
    dealii::PETScWrappers::MPI::SparseMatrix turning;
    /// (v' + w) / R, the stretch at the contact points [1/m]; n, none without contact
    std::vector<TraceRow> stretch;
    /// v at RingParameters::angles_beyond() [-]
    std::vector<TraceRow> beyond;
  };
} // namespace vibrocontact
