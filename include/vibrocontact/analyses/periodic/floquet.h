#pragma once

#include <vibrocontact/analyses/periodic/forced_body.h>

#include <complex>
#include <vector>

namespace vibrocontact
{
  /// Small motion about a periodic one: the body with the tangent stiffness k_p(t) of the law along the orbit, of period T =
  /// 1 / f,
  ///
  ///   q'' + 2 zeta w q' + w^2 q = -sum_p t_p k_p(t) (t_p^T q + r_p),   beta r' + r = -S k(t) (t^T q + r)
  ///
  /// multiplies itself by the Floquet multipliers in every period; the motion is stable if all lie within the unit circle. Laws
  /// are continuous in the gap, so the variation does not jump at touch and release.
  struct TangentContact
  {
    /// [Hz]
    double frequency = 0;
    /// k_p around each of equal parts of the period [N/m]; n_points x n_samples
    std::vector<std::vector<double>> stiffness;
    /// of laws as projections, N = P(N, gap): dP/dN beside k = -dP/dgap; as many, or empty: the force follows from the gap [-]
    std::vector<std::vector<double>> share = {};
  };

  /// Modes up to an angular frequency; the others answer statically (with the body's relaxation), in its residual.
  ForcedBody slow_part(const ForcedBody &body, double omega);

  /// Multipliers by the monodromy matrix, the largest first, for forces that follow from the gap: an impulse k dt at
  /// every sample in contact (second order in the sample), exact motion of the modes from one to the next, one
  /// exponential for each flight.
  std::vector<std::complex<double>> monodromy_multipliers(const ForcedBody &body,
                                                          const TangentContact &contact);

  /// One multiplier by Hill's method: contact forces e^(lambda t) sum_(|k| <= n_harmonics) f_k e^(2 pi j k f t), condensed
  /// onto the contact points,
  ///
  ///   det[ delta_kl + sum k_(k-l) H(lambda + 2 pi j l f) ] = 0,   H: the body's receptance, all modes and residual
  ///
  /// (k_m: Fourier coefficients of k), the zero near a start by secants. With the harmonics of the balance, multiplier +1 is
  /// where its own Jacobian is singular. Without contact the start is returned.
  /// @throws ConvergenceError
  std::complex<double> hill_multiplier(const ForcedBody &body, const TangentContact &contact,
                                       unsigned int n_harmonics, std::complex<double> start);
} // namespace vibrocontact
