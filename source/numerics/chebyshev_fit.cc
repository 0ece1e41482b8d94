#include <vibrocontact/numerics/chebyshev_fit.h>
#include <vibrocontact/numerics/zero_crossing.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace vibrocontact
{
  namespace
  {
    /// cos(pi j (i + 1/2) / n)
    struct ChebyshevCosines
    {
      static constexpr unsigned int n = ChebyshevFit::n;

      ChebyshevCosines()
      {
        for (unsigned int j = 0; j < n; ++j)
          for (unsigned int i = 0; i < n; ++i)
            values[j][i] = std::cos(std::acos(-1.) * j * (i + 0.5) / n);
      }
      double values[n][n];
    };
    const ChebyshevCosines chebyshev_cosines;
  } // namespace

  ChebyshevFit::ChebyshevFit(const std::function<double(double)> &f, const double begin, const double end,
                             double &scale)
      : begin(begin), end(end), c{}
  {
    std::array<double, n> values;
    for (unsigned int i = 0; i < n; ++i)
    {
      values[i] = f(0.5 * (begin + end) + 0.5 * (end - begin) * chebyshev_cosines.values[1][i]);
      scale = std::max(scale, std::abs(values[i]));
    }
    double steepness = 0;
    for (unsigned int j = 0; j < n; ++j)
    {
      for (unsigned int i = 0; i < n; ++i)
        c[j] += values[i] * chebyshev_cosines.values[j][i];
      c[j] *= (j == 0 ? 1. : 2.) / n;
      steepness += j * j * std::abs(c[j]) * 2 / (end - begin);
    }
    last = std::abs(c[n - 1]) + std::abs(c[n - 2]);
    // f is not known better than its argument
    rounding = 1e-14 * scale + 1e-15 * std::max(std::abs(begin), std::abs(end)) * steepness;
  }

  double ChebyshevFit::value(const double x) const
  {
    // Clenshaw's recurrence
    const double y = place(x);
    double b1 = 0, b2 = 0;
    for (unsigned int j = n; j-- > 1;)
      b2 = std::exchange(b1, 2 * y * b1 - b2 + c[j]);
    return y * b1 - b2 + c[0];
  }

  double ChebyshevFit::slope(const double x) const
  {
    // T_j' = j U_(j-1)
    const double y = place(x);
    double before = 0, now = 1, sum = 0;
    for (unsigned int j = 1; j < n; ++j)
    {
      sum += j * c[j] * now;
      before = std::exchange(now, 2 * y * now - before);
    }
    return sum * 2 / (end - begin);
  }

  std::array<double, ChebyshevFit::n> ChebyshevFit::powers() const
  {
    // T_(j+1) = 2 y T_j - T_(j-1)
    std::array<double, n> before{}, now{}, result{};
    before[0] = 1;
    now[1] = 1;
    for (unsigned int i = 0; i < n; ++i)
      result[i] = c[0] * before[i] + c[1] * now[i];
    for (unsigned int j = 2; j < n; ++j)
    {
      std::array<double, n> next{};
      for (unsigned int i = 0; i < n; ++i)
        next[i] = (i > 0 ? 2 * now[i - 1] : 0.) - before[i];
      before = now;
      now = next;
      for (unsigned int i = 0; i < n; ++i)
        result[i] += c[j] * now[i];
    }
    return result;
  }

  namespace
  {
    class BreakSearch
    {
    public:
      BreakSearch(const std::function<double(double)> &f, const double begin, const double end,
                  const double length)
          : f(f), begin(begin), end(end), length(length), shortest(1e-6 * length)
      {
      }

      FunctionBreaks run()
      {
        divide(begin, end);
        for (const auto &[low, high] : unresolved)
        {
          const auto left = one_sided(low, -1), right = one_sided(high, 1);
          if (left && right)
            result.places.push_back(meeting(*left, *right, low, high));
          else
            result.singular.push_back(0.5 * (low + high));
        }
        std::sort(result.places.begin(), result.places.end());
        return result;
      }

    private:
      void divide(const double a, const double b)
      {
        // the outermost points have to lie outside, or a break beyond them is seen from neither side
        const double low = std::max(begin, a - 0.005 * (b - a)), high = std::min(end, b + 0.005 * (b - a));
        if (result.rough || (b - a <= length && ChebyshevFit(f, low, high, scale).resolved()))
          return;
        if (b - a <= shortest)
        {
          // neighbours are one
          if (!unresolved.empty() && low <= unresolved.back().second)
            unresolved.back().second = high;
          else
            unresolved.emplace_back(low, high);
          constexpr double most = 20000;
          result.rough = unresolved.size() > most ||
                         unresolved.back().second - unresolved.back().first > 1000 * shortest;
          return;
        }
        const double middle = a + 0.48121182505960347 * (b - a);
        divide(a, middle);
        divide(middle, b);
      }

      /// As long as is smooth, at most one of the first intervals.
      std::optional<ChebyshevFit> one_sided(const double from, const int direction)
      {
        const double room = direction > 0 ? end - from : from - begin;
        for (double width = std::min(length, room); width > 4 * shortest; width *= 0.5)
        {
          const ChebyshevFit fit(f, direction > 0 ? from : from - width, direction > 0 ? from + width : from,
                                 scale);
          if (fit.resolved())
            return fit;
        }
        return {};
      }

      double meeting(const ChebyshevFit &left, const ChebyshevFit &right, double low, double high) const
      {
        const auto between = [&](const double x) { return low + x * (high - low); };
        const auto apart = [&](const double x) { return left.value(x) - right.value(x); };
        const double noise = 10 * std::max(left.rounding, right.rounding);
        // a jump: to the neighbouring number
        double a = low, b = high;
        bool is_jump = true;
        for (unsigned int k = 0; k < 100; ++k)
        {
          const double middle = 0.5 * (a + b);
          if (!(middle > a && middle < b))
            break;
          is_jump = std::abs(apart(middle)) > noise;
          if (!is_jump)
            break;
          const double value = f(middle);
          (std::abs(value - left.value(middle)) < std::abs(value - right.value(middle)) ? a : b) = middle;
        }
        if (is_jump)
          return b;
        const auto gap = [&](const double x) { return apart(between(x)); };
        if ((gap(0) < 0) != (gap(1) < 0))
          return between(root_between(gap, 0., 1.));
        const auto slopes = [&](const double x) { return left.slope(between(x)) - right.slope(between(x)); };
        if ((slopes(0) < 0) != (slopes(1) < 0))
          return between(root_between(slopes, 0., 1.));
        return 0.5 * (a + b);
      }

      const std::function<double(double)> &f;
      const double begin, end, length, shortest;
      double scale = 0;
      std::vector<std::pair<double, double>> unresolved;
      FunctionBreaks result;
    };
  } // namespace

  FunctionBreaks find_breaks(const std::function<double(double)> &f, const double begin, const double end,
                             const double length)
  {
    return BreakSearch(f, begin, end, length).run();
  }
} // namespace vibrocontact
