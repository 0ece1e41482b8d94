#include <vibrocontact/analyses/limit_cycle/multipliers.h>
#include <vibrocontact/coupled_bodies/stability_roots.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// between the motion and the eigenvector of the trivial multiplier; less: it has none of its own
    constexpr double least_cosine = 0.9;
  } // namespace

  bool CycleStability::is_unstable() const
  {
    return !multipliers.empty() && multipliers.front().growth > uncertainty;
  }

  std::string CycleStability::verdict() const
  {
    if (multipliers.empty() || multipliers.front().growth < -uncertainty)
      return "stable";
    if (!is_unstable())
      return "neutral";
    const std::complex<double> largest = multipliers.front().value;
    if (largest.imag() != 0)
      return "torus";
    return largest.real() > 0 ? "fold" : "period doubling";
  }

  CycleStability cycle_stability(const DenseMatrix &monodromy, const DenseVector &rate, const double period)
  {
    const unsigned int n = monodromy.m();
    DenseVector along(n), next(n);
    // what the rate has beside the direction of the motion is gone after a period
    monodromy.vmult(along, rate);
    along /= along.l2_norm();
    monodromy.vmult(next, along);
    Eigenvalues all = eigenvalues(monodromy);
    // the disturbance along the motion has this direction
    unsigned int trivial = 0;
    double nearest = 0;
    for (unsigned int k = 0; k < n; ++k)
    {
      if (all.values[k].imag() != 0)
        continue;
      double share = 0, square = 0;
      for (unsigned int i = 0; i < n; ++i)
      {
        share += along[i] * all.vectors(i, k);
        square += all.vectors(i, k) * all.vectors(i, k);
      }
      const double cosine = std::abs(share) / std::sqrt(square);
      if (cosine > nearest)
      {
        nearest = cosine;
        trivial = k;
      }
    }
    CycleStability result;
    if (nearest >= least_cosine)
      result.trivial_error = std::abs(all.values[trivial] - 1.);
    else
    {
      // at a fold two multipliers meet at 1 and may part as a pair: the direction of the motion is taken out
      DenseMatrix rest = monodromy;
      DenseVector shares(n);
      monodromy.Tvmult(shares, along);
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          rest(i, j) -= along[i] * shares[j];
      all = eigenvalues(rest);
      trivial = std::min_element(all.values.begin(), all.values.end(),
                                 [](const auto &a, const auto &b) { return std::abs(a) < std::abs(b); }) -
                all.values.begin();
      next -= along;
      result.trivial_error = next.l2_norm();
    }
    result.uncertainty = result.trivial_error / period;
    for (unsigned int k = 0; k < n; ++k)
    {
      const std::complex<double> mu = all.values[k];
      // of a pair the second; what is gone within a period is no disturbance that lasts
      if (k == trivial || mu.imag() < 0 || !(std::abs(mu) > 1e-12))
        continue;
      result.multipliers.push_back(
          {mu, std::log(std::abs(mu)) / period, std::abs(std::arg(mu)) / (2 * dealii::numbers::PI * period)});
    }
    std::sort(result.multipliers.begin(), result.multipliers.end(),
              [](const Multiplier &a, const Multiplier &b) { return a.growth > b.growth; });
    return result;
  }
} // namespace vibrocontact
