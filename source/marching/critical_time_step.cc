#include <vibrocontact/marching/contact_stepper.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vibrocontact
{
  double critical_time_step(const ContactPair &pair)
  {
    double longest = std::numeric_limits<double>::infinity();
    for (unsigned int i = 0; i < pair.n_points(); ++i)
    {
      double mobility = 0;
      for (unsigned int k = 0; k < pair.n_modes(); ++k)
        mobility += pair.trace(i, k) * pair.trace(i, k);
      for (unsigned int k = 0; k < pair.n_poles(); ++k)
        mobility += 2 * (pair.right(i, k) * pair.poles[k] * pair.left(i, k)).real();
      if (!(mobility > 0))
        continue;
      const double at_once = std::max(0., pair.residual(i, i));
      longest = std::min(longest, 2.7 * std::sqrt(at_once / mobility));
      // W / (1 + 2 beta / h) in place of W: halving between what rings and what does not
      const auto rings = [&](const double h)
      {
        double flexibility = at_once;
        for (const RelaxingRest &rest : pair.relaxing)
          flexibility -= 2 * rest.relaxation / (h + 2 * rest.relaxation) * rest.flexibility(i, i);
        return h * h * mobility > 2.7 * 2.7 * flexibility;
      };
      for (double low = 0; !pair.relaxing.empty() && longest - low > 1e-6 * longest;)
        (rings((low + longest) / 2) ? longest : low) = (low + longest) / 2;
    }
    return longest;
  }
} // namespace vibrocontact
