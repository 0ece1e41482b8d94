#pragma once

#include <vibrocontact/coupled_bodies/finite_element_pair.h>

namespace vibrocontact
{
  /// The roots of lowest frequency of unreduced finite elements too many for LAPACK, by SLEPc: the same
  /// problem as inertial_roots(), its constraints kept with their forces as unknowns,
  ///
  ///   [ lambda^2 M + lambda C_b + K + K_b   -P^T E ] [ u  ]
  ///   [ P_n                                   0    ] [ dN ] = 0
  ///
  /// a quadratic eigenvalue problem (TOAR), shift-and-invert about 0 with one LU factorisation of the real
  /// matrix of lambda^0 by MUMPS: the roots nearest to 0 come first, which is the order of their frequencies,
  /// and no complex shift is needed (PETSc is real here). Full sliding only, bodies without modal damping.
  /// Collective.
  /// @throws InputError if points stick or modes are damped; ConvergenceError
  std::vector<StabilityRoot> sparse_roots(const FiniteElementPair &bodies, const ContactPair &pair,
                                          const CreepScheme &scheme, const RollingEquilibrium &equilibrium,
                                          const LinearisationOptions &options, unsigned int n_roots);
} // namespace vibrocontact
