#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/contact/laws/normal_law.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vibrocontact
{
  double NormalLaw::parameter_at(const double a, const double b, const double value) const
  {
    const GraphPoint touch = graph(0);
    double s = value / (a * touch.force_slope + b * touch.penetration_slope);
    if (value == 0 || is_linear())
      return s;
    // the graph rises through zero at s = 0
    const double infinite = std::numeric_limits<double>::infinity();
    double low = value > 0 ? 0 : -infinite, high = value > 0 ? infinite : 0;
    for (unsigned int iteration = 0; iteration < 200 && std::isfinite(s); ++iteration)
    {
      const GraphPoint at = graph(s);
      const double excess = a * at.force + b * at.penetration - value;
      if (excess == 0)
        return s;
      (excess > 0 ? high : low) = s;
      const double step = excess / (a * at.force_slope + b * at.penetration_slope);
      double next = s - step;
      if (std::abs(step) <= 1e-10 * std::abs(s)) // quadratic: the next one would be below round-off
        return next;
      if (!(next > low && next < high))
        next = std::isinf(low) || std::isinf(high) ? 2 * s : 0.5 * (low + high);
      if (next == s)
        return s;
      s = next;
    }
    throw ConvergenceError("The normal law of the contact has no point for the forces that are asked of it: "
                           "its curve does not rise far enough.");
  }

  NormalLaw::Projection NormalLaw::resolvent(const double force, const double gap, const double rho) const
  {
    const double trial = force - rho * gap;
    if (!(trial > 0))
      return {0., 0., 0.};
    const GraphPoint at = graph(parameter_at(1, rho, trial));
    const double share = at.force_slope / (at.force_slope + rho * at.penetration_slope);
    return {at.force, share, -rho * share};
  }

  NormalLaw::Compression NormalLaw::compression(const double force) const
  {
    const GraphPoint at = graph(parameter_at(1, 0, force));
    return {at.penetration, at.penetration_slope / at.force_slope};
  }

  double NormalLaw::integrated_force(const double gap) const
  {
    if (!(gap < 0) || is_rigid())
      return 0;
    static const dealii::QGauss<1> rule(8);
    double sum = 0, begin = 0;
    const auto add_up_to = [&](const double end)
    {
      for (unsigned int i = 0; i < rule.size(); ++i)
      {
        const double depth = begin + (end - begin) * rule.point(i)[0];
        sum += (end - begin) * rule.weight(i) *
               graph(is_function_of_gap() ? depth : parameter_at(0, 1, depth)).force;
      }
      begin = end;
    };
    for (const double depth : breaks())
      if (depth < -gap)
        add_up_to(depth);
    add_up_to(-gap);
    return sum;
  }
} // namespace vibrocontact
