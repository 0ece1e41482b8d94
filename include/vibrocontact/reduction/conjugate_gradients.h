#pragma once

#include <mpi.h>

#include <functional>
#include <vector>

namespace vibrocontact
{
  /// out = A in for several columns, each by own rows, column by column.
  using ColumnOperator =
      std::function<std::vector<double>(const std::vector<double> &in, unsigned int n_columns)>;

  struct ConjugateGradientsResult
  {
    unsigned int n_iterations = 0;
    /// largest |r| / |b| over the columns, r by the recurrence
    double residual = 0;
    /// the same of r = b - A x by one more product, over |b| + 1e-15 |A| |x| / tolerance: no double can tell less
    double measured = 0;
    /// both within the tolerance
    bool converged = false;
  };

  /// Solves A x = b for several columns side by side by preconditioned conjugate gradients: each column has its own
  /// sequence, but products and preconditioner see all of them at once, so that matrix and factors are read from memory
  /// once for all. Ends when every column has |r| <= tolerance |b|; a column that is there stands still.
  /// A, P symmetric positive definite; without breakdown else: it ends as not converged. Collective.
  /// @param columns b on entry, x on return; @param matrix_norm |A|, a bound of its eigenvalues
  /// (Saad 2003, Iterative methods for sparse linear systems, alg. 9.1)
  ConjugateGradientsResult conjugate_gradients(MPI_Comm communicator, const ColumnOperator &matrix,
                                               const ColumnOperator &preconditioner,
                                               std::vector<double> &columns, unsigned int n_columns,
                                               double matrix_norm, double tolerance,
                                               unsigned int most_iterations);
} // namespace vibrocontact
