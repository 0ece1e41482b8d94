#include <vibrocontact/numerics/random_numbers.h>
#include <vibrocontact/waveguide/irregular_supports.h>

#include <cmath>

namespace vibrocontact
{
  std::vector<OwnSupport> irregular_supports(const SupportScatter &scatter, const double mean_spacing,
                                             const bool on_support)
  {
    const int n = scatter.n_supports, first = on_support ? -((n - 1) / 2) : -(n / 2);
    RandomNumbers random(scatter.seed);
    const double log_variance = std::log(1 + std::pow(scatter.pad_stiffness, 2));
    std::vector<OwnSupport> supports(n);
    // distance between support k and k + 1
    std::vector<double> distance(n);
    for (int drawn = 0; drawn < 2 * n + 2; ++drawn)
    {
      const int k = (drawn % 2 == 0 ? drawn / 2 : -(drawn + 1) / 2) - first;
      const double normal = random.normal(), even = 2 * random.uniform() - 1;
      if (k < 0 || k >= n)
        continue;
      supports[k].pad_factor = std::exp(std::sqrt(log_variance) * normal - log_variance / 2);
      distance[k] = mean_spacing * (1 + std::sqrt(3.) * scatter.spacing * even);
    }
    const int middle = -first;
    supports[middle].place = on_support ? 0 : distance[middle - 1] / 2;
    for (int k = middle; k + 1 < n; ++k)
      supports[k + 1].place = supports[k].place + distance[k];
    for (int k = middle; k > 0; --k)
      supports[k - 1].place = supports[k].place - distance[k - 1];
    return supports;
  }
} // namespace vibrocontact
