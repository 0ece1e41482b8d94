#pragma once

#include <cstdint>
#include <vector>

namespace vibrocontact
{
  /// Scatter of pads and distances of the supports about a contact, standard deviation over mean.
  struct SupportScatter
  {
    unsigned int n_supports = 0;
    /// one factor for all directions of a pad, log-normal of mean 1
    double pad_stiffness = 0;
    /// of the distance to the next support, evenly distributed about the mean
    double spacing = 0;
    std::uint64_t seed = 1;
  };

  /// A support that is not one of equal ones.
  struct OwnSupport
  {
    double place = 0;      ///< along the axis [m]
    double pad_factor = 1; ///< by which its pad is stiffer
  };

  /// Supports from left to right about x = 0, which stands on one of them or in the middle between two.
  ///
  /// They are drawn from x = 0 outwards (0, -1, 1, -2, ...), so that a longer track of the same seed goes on with further ones.
  std::vector<OwnSupport> irregular_supports(const SupportScatter &scatter, double mean_spacing,
                                             bool on_support);
} // namespace vibrocontact
