#pragma once

#include <vibrocontact/coupled_bodies/contact_pair.h>

#include <complex>
#include <functional>
#include <optional>
#include <vector>

namespace vibrocontact
{
  /// A body whose receptance at the contact is known at any frequency; the pair has it by poles near that (a periodic rail).
  struct ExactReceptance
  {
    /// counted from 1 in the order of Bodies
    unsigned int body;
    /// 3 n x rank, in the rows of the pair [-]
    DenseMatrix basis;
    /// What it adds to the pair's W~ between its shapes, and what the poles make of that; rank square [m/N], Im s > 0 and
    /// Re s > -loss |s| / 2, behind which its waves no longer decay
    std::function<ComplexMatrix(const std::complex<double> &)> at, by_poles;
    /// `at` and its derivative for many s in few places (numerics/local_polynomials.h)
    std::function<ComplexMatrix(const std::complex<double> &)> nearby, nearby_derivative;
    /// smallest loss factor of what carries its waves [-]; where its poles end [Hz]
    double loss = 0, up_to = 0;
  };

  /// Hysteretic loss of the bodies of a pair, K + j H with H = sum of eta_e K_e over elements and supports, which does not
  /// grow with the frequency:
  ///
  ///   (s^2 + s diag(2 zeta w) + diag(w^2) + j Phi^T H Phi) q = Psi^T R,      du = Psi q + W~ R
  ///
  /// H stands on the modes in full: pads and rail have loss factors of their own, so that it couples them. Modes damped by
  /// number (Eq. 23) have 2 zeta w^2 on its diagonal. W~ of a body has its material's loss factor, W~ / (1 + j eta).
  ///
  /// The equations hold for s with Im s > 0 alone; a motion with Im s < 0 needs K - j H, which has the conjugate roots. Of K + j H
  /// the roots of the lower half plane are spurious: every mode makes one near -j w + eta w / 2, which would grow. Motions
  /// without oscillation, s real, have the elastic stiffness K, as a loss of energy per cycle says nothing of them.
  ///
  /// Viscous damping stays viscous: ratios of bodies without mesh (oscillators, rings), poles, a suspension's dampers.
  struct HystereticLoss
  {
    /// Phi^T H Phi over the modes of the pair; n_modes square [1/s^2]
    DenseMatrix modal;
    /// W~ with its loss; 3 n square [m/N]
    ComplexMatrix residual;
    /// bodies of which no modes are known
    std::vector<ExactReceptance> exact = {};
  };

  /// eta of a body's share of W~; none if its materials have several: then this share stays elastic
  std::optional<double> loss_factor_of_rest(const BodyParameters &body);

  /// The loss of a pair that contact_pair() made of the same; takes it out of the pair's damping ratios, which stay viscous.
  /// @throws InputError if a body is damped by C = beta K as well
  HystereticLoss take_hysteretic_loss(ContactPair &pair, const std::vector<ContactBody> &bodies,
                                      const ContactSections &sections, const PlacedContacts &contacts);
} // namespace vibrocontact
