#include <vibrocontact/analyses/limit_cycle/multipliers.h>
#include <vibrocontact/coupled_bodies/stability_roots.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  std::string CycleStability::verdict() const
  {
    if (multipliers.empty() || multipliers.front().growth < -uncertainty)
      return "stable";
    if (multipliers.front().growth <= uncertainty)
      return "neutral";
    const std::complex<double> largest = multipliers.front().value;
    if (largest.imag() != 0)
      return "torus";
    return largest.real() > 0 ? "fold" : "period doubling";
  }

  CycleStability cycle_stability(const DenseMatrix &monodromy, const DenseVector &rate, const double period)
  {
    const Eigenvalues all = eigenvalues(monodromy);
    const unsigned int n = all.values.size();
    // the disturbance along the motion has the direction of its rate
    unsigned int trivial = 0;
    double nearest = -1;
    for (unsigned int k = 0; k < n; ++k)
    {
      if (all.values[k].imag() != 0)
        continue;
      double along = 0, square = 0;
      for (unsigned int i = 0; i < n; ++i)
      {
        along += rate[i] * all.vectors(i, k);
        square += all.vectors(i, k) * all.vectors(i, k);
      }
      const double cosine = std::abs(along) / std::sqrt(square) / rate.l2_norm();
      if (cosine > nearest)
      {
        nearest = cosine;
        trivial = k;
      }
    }
    CycleStability result;
    result.trivial_error = std::abs(all.values[trivial] - 1.);
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
