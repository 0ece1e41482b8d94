#pragma once

#include <vibrocontact/base/dense.h>

#include <vector>

namespace vibrocontact
{
  /// What steps of an approximate Newton method have shown of the Jacobian J: a step d_k took the residual from r_k to r_k+1 =
  /// r_k - J d_k (Anderson 1965; Fang and Saad 2009, the multisecant form).
  ///
  /// The next direction is exact for what the last residual differences span and by the approximate matrix for the rest:
  ///
  ///   d = X c + K (r - Q c),   Q: orthonormal basis of the differences, X: the steps that made them, c = Q^T r
  class SecantPairs
  {
  public:
    void clear();
    /// @param difference r_k - r_k+1 [N] @param step d_k
    void add(const DenseVector &difference, const DenseVector &step);
    /// residual <- r - Q c. @return X c
    DenseVector take_known_part(DenseVector &residual) const;

  private:
    /// the latest last
    std::vector<DenseVector> differences, steps;
  };
} // namespace vibrocontact
