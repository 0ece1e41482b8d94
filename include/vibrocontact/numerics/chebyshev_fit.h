#pragma once

#include <array>
#include <functional>
#include <vector>

namespace vibrocontact
{
  /// A function of one variable, interpolated in the Chebyshev points of an interval, of which it is asked only in its
  /// inside:
  ///
  ///   f(x) = sum_j c_j T_j(y),      y = (2 x - begin - end) / (end - begin),      j < 16
  struct ChebyshevFit
  {
    static constexpr unsigned int n = 16;

    /// @param scale largest |f| so far, which this may raise
    ChebyshevFit(const std::function<double(double)> &f, double begin, double end, double &scale);

    /// Whether the last coefficients are rounding: of values (1e-14 of the scale) and of the argument.
    bool resolved() const { return last <= rounding; }
    /// also outside of the interval
    double value(double x) const;
    double slope(double x) const;
    /// coefficients of y^j
    std::array<double, n> powers() const;

    double begin, end;
    std::array<double, n> c;
    /// size of the last coefficients; what they may have for rounding
    double last, rounding;

  private:
    double place(const double x) const { return (2 * x - begin - end) / (end - begin); }
  };

  /// Where a function is not smooth.
  struct FunctionBreaks
  {
    /// ascending: jumps of the function (exact: the first number on the right side) or of its slope (to rounding: where
    /// what is smooth on either side meets). Those of its curvature are not looked for.
    std::vector<double> places;
    /// where it is not smooth on one side either, as sqrt(x) at 0
    std::vector<double> singular;
    /// it is not smooth nearly anywhere: the search has ended early
    bool rough = false;
  };

  /// Intervals that ChebyshevFit does not resolve are divided, in an uneven ratio, so that no break hides between two of
  /// them, down to 1e-6 of `length`. Whatever is narrower than a tenth of `length` may be overlooked.
  /// @param length of the first intervals
  FunctionBreaks find_breaks(const std::function<double(double)> &f, double begin, double end, double length);
} // namespace vibrocontact
