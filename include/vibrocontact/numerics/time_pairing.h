#pragma once

#include <vibrocontact/numerics/time_basis.h>

#include <complex>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// Who carries the time derivatives of a weighted residual (Jones & Legrand 2014, Eqs 8-10): strong int p q'', weak
  /// - int p' q', distributional int p'' q (and - int p' q for the first one).
  enum class TimeForm
  {
    strong,
    weak,
    distributional
  };

  /// @throws InputError naming the three forms
  TimeForm time_form(const std::string &name);
  std::string name_of(TimeForm form);

  /// Integrals over the period between weighting functions Psi_m and trial functions Theta_m of equal m; those of
  /// different m vanish (time_basis.h).
  struct TimePairing
  {
    unsigned int n_functions = 0;
    /// A_d(m) = int conj(Psi_m) Theta_m^(d) dt, d = 0, 1, 2, with the derivatives where the form puts them; n_orders
    std::vector<std::complex<double>> a0, a1, a2;
    /// int conj(Psi_m) Psi_m dt, real; n_orders
    std::vector<double> norm;
    /// int conj(Psi_m) sin(2 pi t) dt, m = 1 the only one unless N <= 2 or the quadrature aliases; n_orders
    std::vector<std::complex<double>> sine, cosine;

    /// whether the functions follow a harmonic force in any phase; where not, at N <= 2, it is lost or meets no damping
    bool holds_harmonic() const;
  };

  /// Exact integrals (connection coefficients between wavelets by their refinement equations, Fourier transforms against
  /// Fourier); with `quadrature_points` > 0 by the rule of so many left points instead, as the paper's 256.
  /// @throws InputError saying why if a derivative that the form asks for is not square-integrable (daubechies6 by itself
  /// is allowed in the forms with two derivatives on one side through its connection coefficients, but not by
  /// quadrature), if the numbers of functions differ, or if the points are no multiple of N (wavelets) or too few
  TimePairing pair_time_bases(const TimeBasis &trial, const TimeBasis &weighting, TimeForm form,
                              unsigned int quadrature_points = 0);
} // namespace vibrocontact
