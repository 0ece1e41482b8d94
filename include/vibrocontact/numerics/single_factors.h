#pragma once

#include <vibrocontact/base/dense.h>

#include <vector>

namespace vibrocontact
{
  /// LU factors of a square matrix in single precision, of which a solution reads half the memory.
  ///
  /// The blocks on the diagonals of L and U are kept inverted. So a solution consists of products alone, where LAPACK's
  /// triangles wait for one unknown after the other: of 312 unknowns 6 us in place of 12. Where blocks are nearly singular it is less
  /// exact than by triangles: who uses it looks at what it leaves of a right-hand side.
  class SingleFactors
  {
  public:
    /// Factors of a square matrix. @return false if it has a pivot of zero; then there are none
    bool factorise(const DenseMatrix &matrix);
    void clear() { *this = SingleFactors(); }
    bool empty() const { return n == 0; }
    /// x <- matrix^-1 x; there are factors
    void solve(DenseVector &x) const;

  private:
    void invert_blocks();

    dealii::types::blas_int n = 0;
    SingleMatrix lu;
    std::vector<dealii::types::blas_int> pivots;
    /// one behind the other, those of L, then those of U
    std::vector<float> inverses;
    mutable std::vector<float> single;
  };
} // namespace vibrocontact
