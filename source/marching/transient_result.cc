#include <vibrocontact/marching/transient_result.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  double TransientResult::rms_force() const
  {
    return time > 0 ? std::sqrt(force_square / time) : 0;
  }

  double TransientResult::rms_variation() const
  {
    return time > 0 ? std::sqrt(std::max(0., force_square / time - std::pow(impulse / time, 2))) : 0;
  }

  double TransientResult::rms_tangential() const
  {
    return time > 0 ? std::sqrt(tangential_square / time) : 0;
  }
} // namespace vibrocontact
