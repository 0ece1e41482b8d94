#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/periodic/stop_law.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    // f / a between which the penalty is exponential: alpha d = 2 and, far on the side that only continues it, -1/2
    const double highest = std::expm1(2.), lowest = -0.5;
  } // namespace

  double StopLaw::compression(const double force) const
  {
    if (kind == Kind::rigid)
      return 0;
    if (kind == Kind::spring)
      return force / stiffness;
    const double x = force / amplitude, at = std::clamp(x, lowest, highest);
    return (std::log1p(at) + (x - at) / (1 + at)) / exponent;
  }

  double StopLaw::compliance(const double force) const
  {
    if (kind == Kind::rigid)
      return 0;
    if (kind == Kind::spring)
      return 1 / stiffness;
    return 1 / (stiffness * (1 + std::clamp(force / amplitude, lowest, highest)));
  }

  double StopLaw::energy(const double force) const
  {
    if (kind == Kind::rigid)
      return 0;
    if (kind == Kind::spring)
      return 0.5 * force * force / stiffness;
    return ExponentialPenaltyLaw(amplitude, exponent).potential(-compression(force));
  }

  StopLaw stop_law(const NormalLaw &law)
  {
    const NormalLaw::Description d = law.description();
    if (d.name == "signorini")
      return StopLaw::rigid();
    if (d.name == "linear spring")
      return StopLaw::spring(d.amplitude);
    if (d.name == "exponential penalty")
      return StopLaw::penalty(d.amplitude, d.exponent);
    throw InputError(
        "References in time know the laws signorini, linear spring and exponential penalty, not \"" + d.name +
        "\": take one of these.");
  }
} // namespace vibrocontact
