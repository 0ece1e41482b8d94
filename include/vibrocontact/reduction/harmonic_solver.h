#pragma once

#include <vibrocontact/fe/second_order_system.h>
#include <vibrocontact/fe/trace_row.h>

#include <complex>
#include <memory>
#include <vector>

namespace vibrocontact
{
  /// Harmonic motion of a body with its hysteretic loss and viscous damping, without any reduction:
  ///
  ///   (K + i K'' + i w C - w^2 M) u = f,    u e^{i w t},   K'' = sum of eta_e K_e over cells and pads
  ///
  /// The matrix is complex symmetric, not Hermitian: L D L^T by MUMPS's complex arithmetic (PETSc is built
  /// for real numbers), analysed once, factorised anew for every frequency; four times the operations of a
  /// real factorisation. All members are collective, but for ranks that solve alone.
  ///
  /// A wave around a body that turns (fe/revolved_section.h) has i sign K'' and a term of w beside it:
  ///
  ///   (K + i sign K'' + w B - w^2 M) u = f,    B real and symmetric
  ///
  /// A body seen in axes that turn with it at Omega has Coriolis forces, by which the matrix is no longer symmetric: L U, twice
  /// the operations and entries,
  ///
  ///   (K + i K'' + i w (C + 2 Omega G) - w^2 M) u = f,    G antisymmetric (fe/material_flow.h)
  class HarmonicSolver
  {
  public:
    /// By all ranks together, or every rank alone with all of the matrices: then receptance() is this rank's own.
    enum class Ranks
    {
      together,
      alone
    };
    /// @param of_frequency B, of the pattern of M and K; null: there is none
    /// @param rotation Omega; 0: without Coriolis forces [rad/s]
    explicit HarmonicSolver(const SecondOrderSystem &system, Ranks ranks = Ranks::together,
                            const dealii::PETScWrappers::MPI::SparseMatrix *of_frequency = nullptr,
                            double rotation = 0);
    ~HarmonicSolver();
    HarmonicSolver(const HarmonicSolver &) = delete;
    HarmonicSolver &operator=(const HarmonicSolver &) = delete;

    /// What the factorisation will take on this rank, estimated by its analysis [byte].
    double factorisation_bytes() const;

    /// P (K + i K'' - w^2 M)^-1 P^T between the rows of P, on all ranks: entry [i * n + j] is the motion of
    /// row i under a unit force on row j [m/N]. @param omega [rad/s] @param factor of B @param sign of the loss
    std::vector<std::complex<double>> receptance(double omega, const std::vector<TraceRow> &rows,
                                                 double factor = 0, double sign = 1);

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation;
  };
} // namespace vibrocontact
