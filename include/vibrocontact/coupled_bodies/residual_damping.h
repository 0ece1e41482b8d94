#pragma once

#include <vibrocontact/bodies/reduced_body.h>

#include <vector>

namespace vibrocontact
{
  /// A reduced body whose residual flexibility relaxes, and does not in the analysis at hand.
  struct LossyBody
  {
    const ReducedBody *body;
    /// its row along the normal of the point that is looked at
    unsigned int row = 0;
    /// beta of C = beta K [s], hysteretic loss factor of its material [-]
    double stiffness_damping = 0, loss_factor = 0;
  };

  /// What it changes to leave the damping of residual flexibilities out.
  struct DroppedDamping
  {
    /// of the normal point receptance at the rows, relative [-], at the frequency [Hz] where it
    /// is largest
    double change = 0, frequency = 0;
  };

  /// The massless part of a body answers r = W~ R / (1 + i (beta w + eta)) where the elements are damped by C = beta K
  /// or by a loss factor; transient, stability and modal convolution take W~ R. Relative to the point receptance
  ///
  ///   H = sum over bodies [W~ + sum_k psi_k^2 / (w_k^2 - w^2 + 2 i zeta_k w_k w)] + further
  ///
  /// this changes sum W~ (1 - 1 / (1 + i (beta w + eta))) / H; the largest at the frequencies.
  /// @param further compliance of bodies without modes, half-spaces [m/N]
  DroppedDamping dropped_residual_damping(const std::vector<LossyBody> &bodies, double further,
                                          const std::vector<double> &frequencies);
} // namespace vibrocontact
