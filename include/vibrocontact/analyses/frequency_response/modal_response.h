#pragma once

#include <vibrocontact/reduction/response_reduction.h>

#include <complex>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// Receptance matrix between n points: [i * n + j] [m/N].
  using Receptance = std::vector<std::complex<double>>;

  /// Solves A X = B in place, both by columns. @throws ConvergenceError if A is singular
  void solve_by_columns(std::vector<std::complex<double>> A, std::vector<std::complex<double>> &B);

  /// By modes, responses are asked for up to 3/4 of the frequency that modes reach to: above, those left out resonate.
  /// @param highest frequency that is asked for @param upper_frequency of the modes of a body [Hz]
  /// @param entry of its section Modes that says so
  /// @throws InputError
  void check_reach_of_modes(double highest, const std::string &body, double upper_frequency,
                            const std::string &entry);

  /// Number of modes below a frequency [Hz]; 0: all of them, without Ritz vectors.
  unsigned int modes_below(const ResponseReduction &body, double highest);

  /// Static answer of what is left out by modes, without loss. @param n_modes modes kept, lowest first
  Receptance static_residual(const ResponseReduction &body, unsigned int n_modes);

  /// Exact hysteretic loss on the modes, receptance at each frequency [Hz]: one complex eigenproblem
  /// (diag(w^2) + i D) X = X diag(mu) of modes and Ritz vectors, then
  ///
  ///   H(w) = P X diag(1 / (mu - w^2)) X^-1 P^T + [P G P^T - sum P_k P_k^T / w_k^2]
  ///
  /// The residual in brackets vanishes if all modes are kept, as the Ritz vectors hold the static answers.
  /// With a viscous C or Coriolis forces the equations (diag(w_k^2) + i D + i w (C + 2 Omega G) - w^2) q = P^T f are solved at
  /// each frequency in place of that.
  /// @param n_modes modes kept, lowest first @param rotation Omega of axes that turn with the body [rad/s]
  std::vector<Receptance> hysteretic_response(const ResponseReduction &body, unsigned int n_modes,
                                              const std::vector<double> &frequency, double rotation = 0);

  /// What a run in time has instead: viscous damping of each mode by its strain energy and a residual
  /// flexibility without loss,
  ///
  ///   H(w) = sum P_k P_k^T / (w_k^2 + 2 i zeta_k w_k w - w^2) + [P G P^T - sum P_k P_k^T / w_k^2]
  ///
  /// @param rotation Omega, by which Coriolis forces 2 i Omega w G couple the modes [rad/s]
  std::vector<Receptance> time_domain_response(const ResponseReduction &body, unsigned int n_modes,
                                               const std::vector<double> &frequency, double rotation = 0);

  /// What a rotation does to the vectors of a ResponseReduction that are n waves around the axle (fe/revolved_section.h).
  struct WaveRotation
  {
    unsigned int n_waves = 0;
    /// Omega towards growing theta [rad/s]
    double speed = 0;
    /// Phi^T G Phi of 2 Omega and Phi^T (K_g - C) Phi of Omega^2, n_vectors square, symmetric [-]
    DenseMatrix coriolis, of_square;
  };

  /// Of a body that turns, one of the two waves that even and odd motions make, q_even + i s q_odd, in axes that stand still:
  ///
  ///   (diag(w_k^2) + Omega^2 (K_g - C) + 2 s Omega w G - w^2 + damping) p = P^T (f_even + i s f_odd)
  ///
  /// s = 1 runs towards growing theta, with the material, which sees the frequency v = w - s n Omega: its loss is i sign(v) D,
  /// on modes and Ritz vectors, or the damping of a run in time, 2 i zeta_k w_k v, on the modes alone.
  /// @param sense s; -1 or 1 @param n_modes modes kept, lowest first
  std::vector<Receptance> wave_response(const ResponseReduction &body, const WaveRotation &rotation,
                                        int sense, bool hysteretic, unsigned int n_modes,
                                        const std::vector<double> &frequency);
} // namespace vibrocontact
