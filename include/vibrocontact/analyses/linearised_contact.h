#pragma once

#include <vibrocontact/analyses/contact_pair.h>
#include <vibrocontact/contact/contact_problem.h>

#include <complex>
#include <string>
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
    /// the rate d(W~ R)/dt of the residual displacements in the perturbed slip
    bool residual_rate = true;
    /// points that stick at the equilibrium stay stuck; false: they are refused
    bool stick = false;
  };

  /// A rolling equilibrium and what its slip depends on.
  struct RollingEquilibrium
  {
    /// R and y = (gap, slip) by contact_row(), status
    ContactSolution contact;
    /// mu of each point; n
    std::vector<double> friction;
    /// V [m/s]
    double speed = 0;
    /// the normal force is given, so that the approach moves and sum dN = 0; otherwise the hub is fixed
    bool force_given = false;
  };

  /// The pair linearised about an equilibrium, x' = A x, x = (q, v, z): modal amplitudes and velocities, and
  /// what friction keeps in memory (doc/theory.md, "Steady sliding and its stability", "Time steps").
  ///
  /// Contact points in compression stay closed, open ones open. At a sliding point the friction force is
  ///
  ///   T = -mu N t + tau b,   tau = -c_b ds_b,   c_b = mu N / |s|,   t = s / |s|,  b across it
  ///   ds = V d/dx (Psi_t q + W~_t R) + Psi_t v + W~_t R'
  ///
  /// (Eqs 15-18), at a sticking point ds = 0. N follows from the closed gap, N = -(W~_n E)^-1 (Psi_n q + W~_n
  /// (tau b)), so that tau (T at sticking points) are the only states beside the modes. Without convection
  /// and residual rate this is the paper's reduced problem (Eqs 19-22),
  ///
  ///   (lambda^2 I + lambda (C_r + Psi^T C_b Psi) + diag(w^2) + K_c) q = 0.
  ///
  /// The contact law is Signorini's; the hub is fixed, or the normal force is given.
  /// @throws InputError if points stick and options.stick is false or the residual rate is left out
  DenseMatrix linearised_contact(const ContactPair &pair, const CreepScheme &scheme,
                                 const RollingEquilibrium &equilibrium, const LinearisationOptions &options);

  /// A complex eigenvalue lambda = growth + i 2 pi frequency of a linearised contact.
  struct StabilityRoot
  {
    /// [Hz] >= 0, [1/s]
    double frequency = 0, growth = 0;
    /// Re(lambda) / Im(lambda); positive: unstable
    double divergence_rate = 0;
    /// the free mode with the largest share of its energy, and that share
    std::string label;
    double share = 0;
    /// the free mode that the root began as, see RootPaths; empty if not followed
    std::string path;
    /// modal amplitudes; n_modes
    std::vector<std::complex<double>> shape;
  };

  /// All roots with frequency > 0 by ascending frequency (one of each conjugate pair), then those without
  /// oscillation that grow. @throws ConvergenceError if LAPACK finds no eigenvalues
  std::vector<StabilityRoot> stability_roots(const ContactPair &pair, DenseMatrix linearised);
} // namespace vibrocontact
