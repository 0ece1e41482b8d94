#pragma once

#include <deal.II/base/numbers.h>

#include <cmath>
#include <cstdint>
#include <random>

namespace vibrocontact
{
  /// Random numbers that are the same with every compiler; distributions of the library are not.
  class RandomNumbers
  {
  public:
    explicit RandomNumbers(const std::uint64_t seed) : generator(seed) {}

    /// Between 0 and 1, neither of them.
    double uniform() { return (double(generator() >> 11) + 0.5) / 9007199254740992.; }

    /// Of mean 0 and deviation 1 (Box and Muller 1958): sqrt(-2 log u) cos(2 pi v), u drawn before v.
    double normal()
    {
      const double length = std::sqrt(-2 * std::log(uniform()));
      return length * std::cos(2 * dealii::numbers::PI * uniform());
    }

  private:
    std::mt19937_64 generator;
  };
} // namespace vibrocontact
