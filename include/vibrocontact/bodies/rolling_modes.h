#pragma once

#include <vibrocontact/bodies/body_in_contact.h>

#include <vector>

namespace vibrocontact
{
  /// The material flow of a body of revolution (fe/material_flow.h) in the modes Phi of the same body at rest, or the Coriolis
  /// forces of a body in axes that turn with it, which are `fixed` alone; kept in the cache by itself. Replicated.
  struct FlowReduction
  {
    /// of these modes [rad/s]; n_modes
    std::vector<double> omega;
    /// Phi^T G Phi of both kinds of axes, n_modes square, antisymmetric [-]
    DenseMatrix fixed, turning;
    /// Phi^T (K_g - C) Phi, n_modes square, symmetric (fe/revolved_section.h) [-]; empty: the stress that a body carries
    /// its own rotation with cancels the rest of the terms of Omega^2, as in a ring
    DenseMatrix of_square;
    /// what the poles are called after, by mode; empty: by order and branch
    std::vector<std::string> names;
    /// stretch of the modes at the contact points, n x n_modes [1/(m sqrt(kg))]
    DenseMatrix stretch;
    /// v of the modes at the places beyond the contact points, n_beyond x n_modes [1/sqrt(kg)], and what static forces on
    /// the contact rows do there, n_beyond x 3 n [m/N]
    DenseMatrix beyond, beyond_compliance;

    /// Whether material passes the rows: it does not in axes that turn with it.
    bool flows() const { return turning.m() > 0; }
  };

  /// A body of revolution that rolls, in the modes q of the same body at rest. Rows and forces stand still in the frame of
  /// the road while the material turns past them with Omega:
  ///
  ///   q'' + 2 Omega G q' + 2 diag(zeta w) (q' + Omega G_turning q) + (diag(w^2) + Omega^2 S) q = trace^T f + modal_load
  ///
  /// Damping acts on what the material sees of its deformation, the rate in place and what flows past. S is of_square.
  /// With y = (q, q') this is y' = A y + (0, f), whose eigenvectors are the right shapes of the poles, and those of
  /// A^T the left ones. Modes of different orders have nothing in common, so that A falls into small blocks. The largest
  /// right shape of a pole at the rows is 1, so that its amplitude means the same whatever the signs of the modes are.
  ///
  /// In axes that turn with the body nothing flows: q'' + 2 Omega G q' + 2 diag(zeta w) q' + diag(w^2) q, whose poles are
  /// numbered by frequency.
  ///
  /// Poles with names are waves: "forward" runs as the material does, "backward" against it, none of both stays in place.
  ///
  /// What the modes leave out answers as at rest. That is exact but for its damping, which lacks the share 2 zeta n Omega / w
  /// of its static answer in order n (doc/theory.md, "A rolling ring by elements").
  ///
  /// @param at_rest by modes @param rotation Omega towards growing theta [rad/s]
  /// @return by poles. With 2 n rows for the n points of the flow (friction) `gradient` is
  /// filled: the stretch of the modes; `residual_gradient` is left to the caller.
  /// @throws InputError if a motion grows
  BodyInContact rolling_modes(const BodyInContact &at_rest, const FlowReduction &flow, double rotation);

  /// Complex modes of a body in axes that turn with it, one of each conjugate pair, by frequency.
  struct ComplexModes
  {
    /// lambda [1/s]
    std::vector<std::complex<double>> poles;
    /// of the real modes in each; the largest real part that a factor exp(i phi) gives. n_modes x n_poles
    ComplexMatrix amplitudes;
  };
  ComplexModes complex_modes(const BodyInContact &at_rest, const FlowReduction &coriolis, double rotation);
} // namespace vibrocontact
