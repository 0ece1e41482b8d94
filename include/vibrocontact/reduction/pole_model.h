#pragma once

#include <vibrocontact/base/dense.h>

#include <complex>
#include <string>
#include <vector>

namespace vibrocontact
{
  using ComplexMatrix = dealii::LAPACKFullMatrix<std::complex<double>>;

  /// Green's functions between some rows (contact displacements and forces) in modal form: poles with left and
  /// right shapes and a static residual (Meftah & Duhamel 2011, Eqs 7 and 58; doc/theory.md, "Bodies known by
  /// their Green's functions").
  ///
  ///   z_k' = lambda_k z_k + (left^T f)_k + load_k,     u = 2 Re sum_k right_k z_k + S f
  ///   g(t) = 2 Re sum_k right_k left_k^T e^(lambda_k t) + S delta(t),     t >= 0
  ///   G(omega) = sum_k [ R_k / (j omega - lambda_k) + R_k^* / (j omega - lambda_k^*) ] + S,   R_k = right_k left_k^T
  ///
  /// Of two conjugate poles one is kept, whichever; a real pole carries half its residue. One state per shape
  /// serves all rows. Real modes are the special case right = psi, left = -j psi / (2 omega_d); rolling rings
  /// and identified models have left shapes of their own, G then need not be symmetric. f acts on body 1 along
  /// the row's direction.
  struct PoleModel
  {
    /// lambda_k, n_poles [1/s]
    std::vector<std::complex<double>> poles;
    /// right and left shapes, n_rows x n_poles; their product in [m/(N s)]
    ComplexMatrix right, left;
    /// what constant loads (weight) feed into the states; n_poles
    std::vector<std::complex<double>> load;
    /// S: static answer of what has no poles here, tread included; n_rows square [m/N]
    DenseMatrix residual;
    /// e.g. n=12, branch 1; n_poles or empty
    std::vector<std::string> labels;

    unsigned int n_poles() const { return poles.size(); }
    unsigned int n_rows() const { return right.m(); }
  };

  /// Modes q'' + 2 zeta w q' + w^2 q = trace^T f + load with the displacement trace q + residual f: a pole for
  /// each (two real ones if it is damped beyond critical).
  /// @param trace n_rows x n_modes [1/sqrt(kg)]; @param modal_load n_modes or empty [N/sqrt(kg)]
  /// @throws InputError if a mode is rigid: its two equal poles have no such form
  PoleModel pole_model(const std::vector<double> &omega, const std::vector<double> &damping_ratio,
                       const DenseMatrix &trace, const std::vector<double> &modal_load,
                       const DenseMatrix &residual, const std::vector<std::string> &labels);

  /// 2 Re sum_k weight_k right_k left_k^T, n_rows square: what every quantity of g at real times is.
  /// @param weights n_poles
  DenseMatrix sum_over_poles(const PoleModel &model, const std::vector<std::complex<double>> &weights);
  /// G(omega), n_rows square [m/N]; @param omega [rad/s]
  ComplexMatrix receptance(const PoleModel &model, double omega);
  /// g(t) without its residual, n_rows square [m/(N s)]; @param t [s] >= 0
  DenseMatrix impulse_response(const PoleModel &model, double t);
  /// d^k g / dt^k at t = 0+: 2 Re sum lambda_k^n R_k; n_rows square. Rigid contact needs that of order 0 to be
  /// zero and that of order 1 to be positive definite.
  DenseMatrix initial_derivative(const PoleModel &model, unsigned int order);
} // namespace vibrocontact
