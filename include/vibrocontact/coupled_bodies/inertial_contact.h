#pragma once

#include <vibrocontact/coupled_bodies/contact_pair.h>
#include <vibrocontact/coupled_bodies/stability_roots.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// Two bodies whose contact points carry mass, body 1 minus body 2 in the rows of P:
  ///
  ///   M u'' + C u' + K u = P^T R,      du = P u
  ///
  /// either the finite elements themselves, or modes together with residual attachment modes
  /// (reduction/attachment_inertia.h), where M = I, K = diag(w^2).
  struct InertialPair
  {
    PlacedContacts contacts;
    /// N square, dense [kg], [N s/m], [N/m]
    DenseMatrix mass, damping, stiffness;
    /// P, 3 n x N
    DenseMatrix trace;
    /// amplitudes of the free modes, q = to_modes u (Phi^T M), with their frequencies [rad/s] and names;
    /// n_modes x N
    DenseMatrix to_modes;
    std::vector<double> omega;
    std::vector<std::string> labels;
  };

  /// What contact and friction do to N dofs with the trace P (3 n x N): the dofs of an InertialPair, or those
  /// alone that the contact touches.
  struct ContactCoupling
  {
    /// columns P_n^T and P^T E of the closed points where the law does not yield, N x c; with a given force those under the
    /// hub as differences to the first of them, since their gaps change alike and sum dN = 0
    DenseMatrix gaps, forces;
    /// C_b and K_b: friction across the slip, and along it if it falls with the speed; N square
    DenseMatrix damping, stiffness;
  };

  /// @throws InputError if points stick
  ContactCoupling contact_coupling(const DenseMatrix &trace, const PlacedContacts &contacts,
                                   const CreepScheme &scheme, const RollingEquilibrium &equilibrium,
                                   const LinearisationOptions &options);

  /// The pair as the modes of its bodies, whose residual flexibility has become modes as well.
  InertialPair inertial_pair(const ContactPair &pair);

  /// Complex eigenvalues about an equilibrium in full sliding,
  ///
  ///   (lambda^2 M + lambda (C + C_b) + K + K_b) u = P^T E dN,   P_n u = 0 (or the same for all, sum dN = 0)
  ///
  /// (Lai et al. 2018, Eqs 17-18): C_b damps across the slip, K_b is the convective part of the perturbed
  /// slip, both also along it if friction falls with the slip speed. Closed points are eliminated exactly: u
  /// in the null space of the gaps, tested with the null space of (P^T E)^T; no penalty stands for the
  /// constraint. Dense, LAPACK.
  /// @throws InputError if points stick
  std::vector<StabilityRoot> inertial_roots(const InertialPair &pair, const CreepScheme &scheme,
                                            const RollingEquilibrium &equilibrium,
                                            const LinearisationOptions &options);
} // namespace vibrocontact
