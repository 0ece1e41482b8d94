#include <vibrocontact/numerics/doubled_step.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vibrocontact
{
  double doubled_step_error(const double fine, const double coarse)
  {
    return doubled_step_error_of(fine, coarse, std::max(std::abs(fine), std::abs(coarse)));
  }

  double doubled_step_error_of(const double fine, const double coarse, const double size)
  {
    if (!std::isfinite(fine) || !std::isfinite(coarse))
      return std::numeric_limits<double>::infinity();
    return size > 0 ? std::abs(fine - coarse) / (std::sqrt(3.) * size) : 0.;
  }

  double doubled_step_error(const double fine, const double coarse, const double coarsest)
  {
    const double least = 0.5 * doubled_step_error(fine, coarse),
                 size = std::max(std::abs(fine), std::abs(coarse));
    if (!std::isfinite(coarsest) || !(size > 0))
      return 2 * least;
    return std::max(least, std::abs((coarse - coarsest) / 3 - 5 * (fine - coarse) / 3) / size);
  }
} // namespace vibrocontact
