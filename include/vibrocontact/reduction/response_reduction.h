#pragma once

#include <vibrocontact/reduction/harmonic_solver.h>
#include <vibrocontact/reduction/modes.h>

#include <functional>
#include <vector>

namespace vibrocontact
{
  /// What harmonic motion between some points of a body needs of its modes, loss coupling included; kept in
  /// the cache by itself. Rigid modes first. Replicated.
  ///
  ///   (diag(w^2) + i D - w^2) q = P^T R,   u = P q,   D = Phi^T K'' Phi
  ///
  /// The modes kept are followed by a few Ritz vectors that carry what they leave out: the static answers G
  /// P^T to forces on the points and the first correction by the loss, G K'' G P^T, made orthogonal to the
  /// modes and to each other in K and M. They are coupled to the modes by D like any mode.
  struct ResponseReduction
  {
    unsigned int n_dofs = 0, n_rigid_modes = 0;
    /// of modes and Ritz vectors [rad/s]; n_vectors
    std::vector<double> omega;
    /// of the modes [-]; n_modes
    std::vector<double> damping_ratio;
    /// D: what cells and pads lose by their own loss factors, full; n_vectors square [1/s^2]
    DenseMatrix loss;
    /// Phi^T C Phi of a viscous damping matrix, full; n_vectors square or, without one, empty [1/s]
    DenseMatrix damping = DenseMatrix();
    /// Phi^T G Phi of a body seen in axes that turn with it (fe/material_flow.h), antisymmetric; n_vectors square or empty [-]
    DenseMatrix gyroscopic = DenseMatrix();
    /// motion of the points; n_points x n_vectors [1/sqrt(kg)]
    DenseMatrix trace;
    /// P G P^T with the real stiffness (inertia relief if the body is free) [m/N]
    DenseMatrix compliance;
    /// wall time of the computation, that of the modes not included [s]
    double seconds = 0;
  };

  /// Receptances found frequency by frequency; kept in the cache by itself.
  struct DirectResponse
  {
    /// [Hz]
    std::vector<double> frequency;
    /// row k: receptance matrix at frequency k, [i * n_points + j] [m/N]
    DenseMatrix real, imaginary;
    double seconds = 0;
  };

  /// Of direct responses in the cache: the key of a body with every frequency [Hz] in full.
  std::string key_at(const std::string &key, const std::vector<double> &frequency);

  /// @param wheel damped by mode: its damping ratios are added to D as 2 zeta w^2
  /// @param basis if given, takes the modes and Ritz vectors themselves
  ResponseReduction reduce_response(const SecondOrderSystem &system, Flexibility &flexibility,
                                    const Modes &modes, const std::vector<double> &damping_ratio, bool wheel,
                                    const std::vector<TraceRow> &points,
                                    std::vector<dealii::PETScWrappers::MPI::Vector> *basis = nullptr);

  /// By all ranks together, or, of several frequencies, shared out over ranks that hold all factors each if their memory
  /// allows it. Collective. @param advance called after each frequency @param rotation see HarmonicSolver
  DirectResponse solve_directly(const SecondOrderSystem &system, const std::vector<TraceRow> &points,
                                const std::vector<double> &frequency, const std::function<void()> &advance,
                                double rotation = 0);
} // namespace vibrocontact
