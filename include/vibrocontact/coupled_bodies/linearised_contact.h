#pragma once

#include <vibrocontact/coupled_bodies/contact_pair.h>
#include <vibrocontact/coupled_bodies/hysteretic_loss.h>
#include <vibrocontact/coupled_bodies/rolling_equilibrium.h>

#include <vector>

namespace vibrocontact
{
  /// What the linearisation about a rolling equilibrium keeps.
  struct LinearisationOptions
  {
    /// damping C_b of sliding friction across the slip direction (Lai et al. 2018, Eq. 16)
    bool lateral_damping = true;
    /// the convective part V d/dx of the perturbed slip, which the paper leaves out
    bool convection = true;
    /// the rate d(W~ R)/dt of the residual displacements in the perturbed slip; without it they do not relax
    bool residual_rate = true;
    /// points that stick at the equilibrium stay stuck; false: they are refused
    bool stick = false;
  };

  /// W~ of the pair and, on the diagonal of its gaps, what the normal law yields at the equilibrium; 3 n square [m/N].
  DenseMatrix compliance_of_contact(const ContactPair &pair, const RollingEquilibrium &equilibrium);

  /// W~ with loss and what the normal law yields at the equilibrium; 3 n square [m/N].
  ComplexMatrix compliance_of_contact(const HystereticLoss &loss, const RollingEquilibrium &equilibrium);

  /// How the gaps of some points close where the hub of body 1 moves down [-].
  std::vector<double> gaps_by_approach(const ContactPair &pair, const std::vector<unsigned int> &points);

  /// The pair linearised about an equilibrium, x' = A x, x = (q, v, Re z, Im z, s, tau): modal amplitudes and velocities,
  /// poles, forces that rests have relaxed to, and what friction keeps in memory (doc/theory.md, "Steady sliding and its
  /// stability", "Time steps").
  ///
  /// Contact points in compression stay closed, open ones open. At a sliding point the friction force is
  ///
  ///   T = -mu N t + tau b,   tau = -c_b ds_b,   c_b = mu N / |s|,   t = s / |s|,  b across it
  ///   ds = V d/dx (Psi_t q + W~_t R) + Psi_t v + W~_t R'
  ///
  /// (Eqs 15-18), at a sticking point ds = 0. N follows from the closed gap, N = -(W~_n E)^-1 (Psi_n q + W~_n
  /// (tau b)), so that tau (T at sticking points) are the only states beside the modes. A rest that relaxes
  /// (ContactPair::relaxing) brings r = W s, s' = (R - s) / beta in place of W R, with s in the span of the frame's forces.
  /// Where nothing else gives way, a point follows forces by its rate alone: N from the gap's rate (plus the gap over beta,
  /// which the closed gap leaves zero), tau from the slip without a state of its own. Without convection
  /// and residual rate this is the paper's reduced problem (Eqs 19-22),
  ///
  ///   (lambda^2 I + lambda (C_r + Psi^T C_b Psi) + diag(w^2) + K_c) q = 0.
  ///
  /// If friction falls with the slip speed (RollingEquilibrium::friction_slope), T has one more part along t,
  ///
  ///   -N (dmu/ds) ds_t t,    ds_t = V d/dx (Psi_t q + W~_t R) + Psi_t v  along t,
  ///
  /// a negative damping. The rate of the residual displacements is no part of that slip, as in the law itself
  /// (contact/friction_of_speed.h).
  ///
  /// A normal law that yields adds its compliance at the equilibrium to the normal diagonal of W~; where its force were to
  /// vanish the contact is taken as closed all the same. The hub is fixed, or the normal force is given.
  /// @throws InputError if points stick and options.stick is false or the residual rate is left out
  DenseMatrix linearised_contact(const ContactPair &pair, const CreepScheme &scheme,
                                 const RollingEquilibrium &equilibrium, const LinearisationOptions &options);

  /// x' = A x of linearised_contact() with loss, about motions e^(s t) with Im s > 0. The states are the same.
  ComplexMatrix linearised_contact(const ContactPair &pair, const HystereticLoss &loss,
                                   const CreepScheme &scheme, const RollingEquilibrium &equilibrium,
                                   const LinearisationOptions &options);
} // namespace vibrocontact
