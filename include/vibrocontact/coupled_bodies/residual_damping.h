#pragma once

#include <vibrocontact/bodies/reduced_body.h>

#include <vector>

namespace vibrocontact
{
  /// A reduced body whose residual flexibility is damped, and in the analysis at hand not or by a relaxation alone.
  struct LossyBody
  {
    const ReducedBody *body;
    /// its row along the normal of the point that is looked at
    unsigned int row = 0;
    /// beta of C = beta K [s], hysteretic loss factor of its material [-]
    double stiffness_damping = 0, loss_factor = 0;
    /// beta that the analysis takes [s]
    double relaxation = 0;
  };

  /// What it changes to leave the damping of residual flexibilities out.
  struct DroppedDamping
  {
    /// of the normal point receptance at the rows, relative [-], at the frequency [Hz] where it
    /// is largest
    double change = 0, frequency = 0;
  };

  /// The massless part of a body answers r = W~ R / (1 + i (beta w + eta)) where the elements are damped by C = beta K
  /// or by a loss factor; transient, stability and modal convolution take W~ R / (1 + i beta w), as eta is not causal, or
  /// W~ R where they say so. Relative to the point receptance
  ///
  ///   H = sum over bodies [r + sum_k psi_k^2 / (w_k^2 - w^2 + 2 i zeta_k w_k w)] + further
  ///
  /// with the r that is taken this changes the sum of the differences of both r / H; the largest at the frequencies.
  /// @param further compliance of bodies without modes, half-spaces [m/N]
  DroppedDamping dropped_residual_damping(const std::vector<LossyBody> &bodies, double further,
                                          const std::vector<double> &frequencies);
} // namespace vibrocontact
