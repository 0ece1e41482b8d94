#pragma once

#include <vibrocontact/base/dense.h>

#include <vector>

namespace vibrocontact
{
  /// LU factors of a square matrix in single precision, of which a solution reads half the memory.
  ///
  /// The blocks on the diagonals of L and U are kept inverted. So a solution consists of products alone, where LAPACK's
  /// triangles wait for one unknown after the other: it takes half the time.
  class SingleFactors
  {
  public:
    /// Factors of a matrix. @return false if it is singular; then there are none
    bool factorise(const SingleMatrix &matrix);
    void clear() { n = 0; }
    bool empty() const { return n == 0; }
    /// x <- matrix^-1 x
    void solve(SingleVector &x) const;

  private:
    void invert_blocks();

    dealii::types::blas_int n = 0;
    std::vector<float> lu;
    std::vector<dealii::types::blas_int> pivots;
    /// one behind the other, those of L, then those of U
    std::vector<float> inverses;
  };
} // namespace vibrocontact
