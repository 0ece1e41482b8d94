#pragma once

#include <vibrocontact/reduction/modes.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// A way to solve G M phi = phi / w^2 for the lowest elastic modes. All use the factorised stiffness at
  /// shift 0.
  struct ModeSolver
  {
    /// name in the entry Modes/Solver, one line for the reader of the file
    std::string name, help;
    /// Adds to `modes` the `n_wanted` lowest elastic modes that it does not have yet (perhaps some more),
    /// ascending. `mass` is M without stored zeros. @throws ConvergenceError
    void (*solve)(const SecondOrderSystem &system, Flexibility &flexibility, Mat mass, unsigned int n_wanted,
                  Modes &modes);
  };

  /// block Krylov, Krylov-Schur
  const std::vector<ModeSolver> &mode_solvers();

  /// Block Krylov method with full orthogonalisation and Rayleigh-Ritz, no restart:
  ///
  ///     W = G M X_j,   W <- W - Q (Q^T M W) twice,   X_{j+1} R = W,   X^T M X = I,   H = Q^T M G M Q
  ///
  /// until the residuals |R s| of all wanted Ritz vectors of H are below 1e-10 of their Ritz value 1/w^2.
  /// A solve reads all factors from memory, so that the columns of a block cost little more than one; and a
  /// block sees both modes of a pair at once, which a single sequence only finds through round-off.
  void block_krylov(const SecondOrderSystem &system, Flexibility &flexibility, Mat mass,
                    unsigned int n_wanted, Modes &modes);

  /// SLEPc's Krylov-Schur method, one vector at a time, with the factorised stiffness as shift-and-invert
  /// operator.
  void krylov_schur(const SecondOrderSystem &system, Flexibility &flexibility, Mat mass,
                    unsigned int n_wanted, Modes &modes);

  /// Sorts modes by frequency.
  void sort_modes(Modes &modes);
} // namespace vibrocontact
