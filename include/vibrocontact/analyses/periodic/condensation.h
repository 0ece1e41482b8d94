#pragma once

#include <vibrocontact/analyses/periodic/forced_body.h>
#include <vibrocontact/numerics/time_pairing.h>

#include <complex>
#include <vector>

namespace vibrocontact
{
  /// All linear unknowns of a periodic motion eliminated onto the contact rows, exactly and order by order:
  ///
  ///   u_m = linear_m + H_m p_m,   H_m = sum_n t_n t_n^T / d_n(m) + sum_k R_k / (f A1 - lambda_k A0) + S / (A0 + f beta A1),
  ///   d_n(m) = f^2 A2(m) + 2 zeta_n w_n f A1(m) + w_n^2 A0(m),      R_k = right_k left_k^T, conjugate poles too
  ///
  /// u_m: coefficients of the rows' motion in the trial functions; p_m = int conj(Psi_m) p dt: moments of the forces on
  /// the rows; t_n: column n of the trace. With Fourier functions H_m is the receptance at m f (doc/theory.md, "Periodic
  /// motion"). Slopes are derivatives with respect to the frequency f.
  struct CondensedBody
  {
    unsigned int n_rows = 0, n_functions = 0;
    /// H_m [m/N]: [(m * n_rows + i) * n_rows + j]
    std::vector<std::complex<double>> compliance, compliance_slope;
    /// motion without contact, static loads included [m]: [m * n_rows + i]
    std::vector<std::complex<double>> linear, linear_slope;
  };

  /// Largest |H_m| of a row on itself over the orders [m/N].
  double largest_compliance(const CondensedBody &body, unsigned int row);

  /// @param growth lambda of motions e^(lambda t) times the functions: f A1 + lambda A0 in place of f A1, and its square's
  /// likewise; compliance alone is right then [1/s]
  CondensedBody condense(const ForcedBody &body, const TimePairing &pairing, const HarmonicForce &force,
                         double growth = 0);

  /// Logarithm of prod_n prod_m |d_n(m)| over all modes and over all orders, those of conjugate coefficients twice: its zeros are
  /// the poles of what is condensed.
  double log_of_poles(const ForcedBody &body, const TimePairing &pairing, double frequency, double growth);

  /// Coefficients of every mode under the moments p of the row forces, in the real layout of time_basis.h:
  /// N x n_modes [m sqrt(kg)].
  DenseMatrix modal_coefficients(const ForcedBody &body, const TimePairing &pairing,
                                 const HarmonicForce &force, const std::vector<double> &p);
} // namespace vibrocontact
