#include <vibrocontact/numerics/amplitude_growth.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  AmplitudeGrowth amplitude_growth(const std::vector<double> &times, const std::vector<double> &amplitudes,
                                   const double from, const double to)
  {
    AmplitudeGrowth result;
    double t = 0, a = 0;
    const auto use = [&](const std::size_t i)
    { return times[i] >= from && times[i] <= to && amplitudes[i] > 0; };
    for (std::size_t i = 0; i < times.size(); ++i)
      if (use(i))
      {
        ++result.n_samples;
        t += times[i];
        a += std::log(amplitudes[i]);
      }
    if (result.n_samples < 2)
      return result;
    t /= result.n_samples;
    a /= result.n_samples;
    double tt = 0, ta = 0, aa = 0;
    for (std::size_t i = 0; i < times.size(); ++i)
      if (use(i))
      {
        const double dt = times[i] - t, da = std::log(amplitudes[i]) - a;
        tt += dt * dt;
        ta += dt * da;
        aa += da * da;
      }
    result.growth = ta / tt;
    result.residual = std::sqrt(std::max(0., aa - ta * ta / tt) / result.n_samples);
    result.uncertainty = result.residual * std::sqrt(result.n_samples / tt);
    return result;
  }
} // namespace vibrocontact
