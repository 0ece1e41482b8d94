#pragma once

#include <vibrocontact/base/dense.h>

#include <array>
#include <vector>

namespace vibrocontact
{
  /// What steps of an approximate Newton method have shown of the Jacobian J: a step d_k took the residual from r_k to r_k+1 =
  /// r_k - J d_k (Anderson 1965; Fang and Saad 2009, the multisecant form).
  ///
  /// The next direction is exact for what the last residual differences F span and by the approximate matrix for the rest:
  ///
  ///   d = X c + K (r - F c),   X: the steps that made them, c: least |r - F c|
  ///
  /// by Cholesky's factors of F^T F from the latest difference on, without those that later ones leave nothing of.
  class SecantPairs
  {
  public:
    void clear() { n = 0; }
    /// @param difference r_k - r_k+1 [N] @param step d_k
    void add(const DenseVector &difference, const DenseVector &step);
    /// residual <- r - F c. @return X c
    DenseVector take_known_part(DenseVector &residual) const;

  private:
    static constexpr unsigned int most_pairs = 8;

    struct Pair
    {
      DenseVector difference, step;
    };
    /// the first n of them, the latest in the place `latest`, earlier ones before it, around the end
    std::array<Pair, most_pairs> pairs;
    unsigned int n = 0, latest = 0;
    /// F^T F
    std::array<std::array<double, most_pairs>, most_pairs> products;
  };
} // namespace vibrocontact
