#pragma once

#include <array>
#include <cmath>

namespace vibrocontact
{
  /// Where a function passes through zero between a and b, of different signs there: false position that does not get
  /// stuck on one side (Anderson & Bjorck, BIT 13 (1973) 253), to rounding of x of order one.
  template <typename Function>
  double root_between(const Function &f, double a, double b)
  {
    double fa = f(a), fb = f(b), before = a;
    // which end was moved last; the value at the other is lessened if it was the same end before
    char moved = 0;
    const auto lessened = [](const double ratio) { return ratio < 1 ? 1 - ratio : 0.5; };
    for (unsigned int k = 0; k < 200 && b - a > 1e-16; ++k)
    {
      double x = k % 8 == 7 || fa == fb ? 0.5 * (a + b) : (a * fb - b * fa) / (fb - fa);
      if (!(x > a && x < b))
        x = 0.5 * (a + b);
      if (!(x > a && x < b))
        break;
      const double fx = f(x);
      if (fx == 0 || std::abs(x - before) < 2e-15)
        return x;
      before = x;
      if ((fx < 0) == (fb < 0))
      {
        if (moved == 'b')
          fa *= lessened(fx / fb);
        b = x;
        fb = fx;
        moved = 'b';
      }
      else
      {
        if (moved == 'a')
          fb *= lessened(fx / fa);
        a = x;
        fa = fx;
        moved = 'a';
      }
    }
    return 0.5 * (a + b);
  }

  /// Nine equal samples of [0, 1] for first_zero_crossing().
  struct CrossingSamples
  {
    static constexpr unsigned int n = 9;
    static constexpr std::array<double, n> x = {{0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1}};
  };

  /// The first zero crossing downwards, by more than rounding, of a smooth function of x from 0 to 1; 2: none. Smallest
  /// values between samples are found by its slope.
  /// @param values f at CrossingSamples::x; the first has to be 0 if the function starts at zero, which is no crossing
  template <typename Value, typename Slope>
  double first_zero_crossing(const std::array<double, CrossingSamples::n> &values, const Value &f,
                             const Slope &slope, const double rounding)
  {
    constexpr unsigned int last = CrossingSamples::n - 1;
    const auto &place = CrossingSamples::x;
    // where it passes zero between a sample and a place below zero
    const auto crossing = [&](double x, double value, const double low)
    {
      // what begins with zero may rise and fall within the first interval
      for (unsigned int j = 1; j <= 40 && value <= 0; ++j)
      {
        const double nearer = x + (low - x) * std::ldexp(1., -static_cast<int>(j)), there = f(nearer);
        if (there <= 0)
          continue;
        value = there;
        x = nearer;
      }
      return value > 0 ? root_between(f, x, low) : x;
    };
    for (unsigned int k = 1; k <= last; ++k)
    {
      if (values[k] < -rounding)
        return crossing(place[k - 1], values[k - 1], place[k]);
      // a smallest value between samples
      unsigned int left = last;
      if (k >= 2 && values[k - 1] <= values[k - 2] && values[k - 1] < values[k])
        left = k - 2;
      else if (k == 1 && values[1] > values[0])
        left = 0;
      else if (k == last && values[k] < values[k - 1])
        left = k - 1;
      if (left == last)
        continue;
      const double down = slope(place[left]);
      // not below the tangent, with as much again for what bends otherwise
      if (down >= 0 || values[left] + 2 * down * (place[k] - place[left]) >= -rounding ||
          slope(place[k]) <= 0)
        continue;
      const double low = root_between(slope, place[left], place[k]);
      if (f(low) < -rounding)
        return crossing(place[left], values[left], low);
    }
    return 2;
  }
} // namespace vibrocontact
