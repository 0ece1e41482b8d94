#pragma once

#include <vibrocontact/coupled_bodies/stability_roots.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace vibrocontact
{
  /// Largest relative distance of a root to the nearest one of others.
  inline double distance(const std::vector<StabilityRoot> &roots, const std::vector<StabilityRoot> &others)
  {
    constexpr double two_pi = 2 * dealii::numbers::PI;
    double worst = 0;
    for (const StabilityRoot &a : roots)
    {
      double least = 1e300;
      for (const StabilityRoot &b : others)
        least = std::min(least, std::hypot(a.growth - b.growth, two_pi * (a.frequency - b.frequency)) /
                                    std::max(1., std::hypot(a.growth, two_pi * a.frequency)));
      worst = std::max(worst, least);
    }
    return worst;
  }
} // namespace vibrocontact
