#pragma once

#include <vibrocontact/base/dense.h>
#include <vibrocontact/numerics/wide_loops.h>

#include <vector>

namespace vibrocontact
{
  /// y += M x of one real matrix and many x: M as columns, or as the product of two thin matrices.
  class ThinProduct
  {
  public:
    ThinProduct() = default;
    /// M = factors[0], or M = factors[0] factors[1]
    explicit ThinProduct(const std::vector<DenseMatrix> &factors);
    /// @param y padded() to the rows of M; @param x as many as M has columns
    void add_to(double *y, const double *x);
    /// the same of an x with many zeros
    void add_sparse_to(double *y, const double *x);

  private:
    struct Columns
    {
      std::size_t length = 0, n = 0;
      AlignedVector entries;

      explicit Columns(const DenseMatrix &matrix);
      void add_to(double *y, const double *x) const;
    };

    /// the first one is multiplied with x, the second one, if there is one, with what that gives
    std::vector<Columns> columns;
    AlignedVector between;
    std::vector<unsigned int> listed;
    std::vector<double> factors;
  };

  /// Two ways between the rows of a body and its states through few shapes. Rows that are near to each other move in few
  /// independent ways: what states and rows have to do with each other is then a product of two thin matrices
  /// (bodies/patch_shapes.h). Singular values below 1e-14 of the largest are left out, each state's largest row counting as one.
  /// Of fewer than 32 rows or states, and where two matrices would take more work, it stays one.
  struct RowsAndStates
  {
    /// displacements += right states, states += left^T forces
    ThinProduct show, load;
  };

  /// @param right, left n_rows x n_states each, of real and imaginary parts
  RowsAndStates rows_and_states(const DenseMatrix &right, const DenseMatrix &left);
} // namespace vibrocontact
