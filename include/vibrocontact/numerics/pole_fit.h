#pragma once

#include <vibrocontact/base/dense.h>

#include <complex>
#include <vector>

namespace vibrocontact
{
  /// Several functions of frequency on one axis, to be fitted by common poles.
  struct Spectra
  {
    /// ascending, not negative [rad/s]
    std::vector<double> omega;
    /// one list per entry, as long as omega
    std::vector<std::vector<std::complex<double>>> values;
    /// what a difference counts at each line, for poles, residues and their errors; empty: 1
    std::vector<double> weight = {};

    double weight_of(const unsigned int line) const { return weight.empty() ? 1. : weight[line]; }

    unsigned int n_entries() const { return values.size(); }
  };

  /// Entries in modal form with common poles (Meftah & Duhamel 2011, Eq. 7):
  ///
  ///   G_i(omega) = sum_k [ R_ik / (j omega - lambda_k) + R_ik^* / (j omega - lambda_k^*) ] + d_i
  ///
  /// Of two conjugate poles that with Im > 0 is kept; a real pole (Im = 0) carries half its residue.
  struct PoleFit
  {
    /// [1/s]
    std::vector<std::complex<double>> poles;
    /// residues[i][k] of entry i [unit of the data * 1/s]
    std::vector<std::vector<std::complex<double>>> residues;
    /// d_i, zero without direct term [unit of the data]
    std::vector<double> direct;
    /// whether the search for the poles came to rest (vector fitting: E within 1e-4 in three relocations)
    bool converged = true;

    /// Two real poles count as a pair.
    double n_pairs() const;
    unsigned int n_unstable() const;
    std::complex<double> value(unsigned int entry, double omega) const;
    /// 2 Re sum lambda_k^order R_ik: the impulse response (0) or its slope (1) at t = 0+
    double initial(unsigned int entry, unsigned int order) const;
  };

  /// What the residues have to fulfil beside being the best in the sense of least squares.
  struct ResidueRules
  {
    /// constant d_i beside the poles
    bool direct = false;
    /// g(0+) = 2 Re sum R_ik = 0 for every entry
    bool zero_initial_value = false;
    /// slope g'(0+) = 2 Re sum lambda_k R_ik per entry; empty: left free
    std::vector<double> initial_slope;
    /// purely imaginary residues: the paper's A_k / (omega_k^2 + 2 j xi_k omega_k omega - omega^2), Eq. 8; real
    /// poles are dropped
    bool real_amplitudes = false;
  };

  /// The functions of frequency that belong to real unknowns: for a pair 1/(s-l) + 1/(s-l*) (real part of its
  /// residue) and j/(s-l) - j/(s-l*) (imaginary part), for a real pole 1/(s-l). Real parts of all lines, then
  /// the imaginary parts: 2 n_lines x n_unknowns.
  DenseMatrix pole_basis(const std::vector<double> &omega, const std::vector<std::complex<double>> &poles);

  /// Least squares on the data with given poles. LAPACK.
  PoleFit fit_residues(const Spectra &data, const std::vector<std::complex<double>> &poles,
                       const ResidueRules &rules = {});

  /// E of Eq. 9: integral of |other - exact| over that of |exact|, by trapezoids over omega.
  double band_error(const std::vector<double> &omega, const std::vector<std::complex<double>> &exact,
                    const std::vector<std::complex<double>> &other);
  /// E of Eq. 9 per entry: integral of |G - fit| over that of |G|, both with the lines' weights, by trapezoids over the axis.
  std::vector<double> fit_errors(const Spectra &data, const PoleFit &fit);
  /// That of the worst entry.
  double worst_error(const Spectra &data, const PoleFit &fit);
} // namespace vibrocontact
