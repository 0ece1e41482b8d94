#pragma once

#include <Sacado_Fad_SFad.hpp>

#include <cmath>

namespace vibrocontact
{
  /// A number that carries its derivative along, for formulas of laws. Included in the sources of laws alone.
  using DifferentiableNumber = Sacado::Fad::SFad<double, 1>;

  inline double expm1(const double x)
  {
    return std::expm1(x);
  }

  /// exp(x) - 1 without cancellation, which Sacado has not
  inline DifferentiableNumber expm1(const DifferentiableNumber &x)
  {
    const double value = std::expm1(x.val());
    DifferentiableNumber result(value);
    result.fastAccessDx(0) = (value + 1) * x.dx(0);
    return result;
  }

  struct ValueAndSlope
  {
    double value, slope;
  };

  /// f(x) and f'(x) of a formula that takes any kind of number.
  template <typename Formula>
  ValueAndSlope value_and_slope(const Formula &f, const double x)
  {
    DifferentiableNumber number(x);
    number.fastAccessDx(0) = 1;
    const DifferentiableNumber result = f(number);
    return {result.val(), result.dx(0)};
  }
} // namespace vibrocontact
