#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/numerics/short_wave_share.h>
#include <vibrocontact/scene/carried_waves.h>

namespace vibrocontact
{
  double check_carried_waves(const std::string &name, const std::function<double(double)> &height,
                             const double begin, const double end, const double spacing,
                             const std::string &spacing_entry)
  {
    constexpr double most = 0.25;
    const double share = short_wave_share(height, begin, end, spacing);
    if (share > most)
      throw InputError(name + " has " + percent_text(share, 0) +
                       " of its heights (rms) in waves shorter than " + number_text(2 * spacing) +
                       " m, two spacings of the contact points, which see them as "
                       "longer ones: smooth it, or make " +
                       spacing_entry + " smaller.");
    return share;
  }

  void check_carried_wave(const std::string &name, const double wavelength, const double spacing,
                          const std::string &way_out)
  {
    if (wavelength < 2 * spacing * (1 - 1e-9))
      throw InputError(name + " has waves of " + number_text(wavelength) + " m, but contact points " +
                       number_text(spacing) + " m apart see those shorter than " + number_text(2 * spacing) +
                       " m as longer ones: " + way_out + ".");
  }
} // namespace vibrocontact
