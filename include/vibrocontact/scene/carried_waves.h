#pragma once

#include <functional>
#include <string>

namespace vibrocontact
{
  /// Points at equal distances see a wave shorter than two of them as a longer one, which is not there.
  ///
  /// @param name of the height for messages; @param spacing of the points and its entry for the way out [m]
  /// @return what is in such waves over the way from begin to end (short_wave_share()): up to a quarter, as in steps and
  /// kinks, it is let pass
  /// @throws InputError beyond
  double check_carried_waves(const std::string &name, const std::function<double(double)> &height,
                             double begin, double end, double spacing, const std::string &spacing_entry);

  /// The same for the shortest of waves that are known.
  /// @param name such as a band of a file; @param way_out what can be done to the waves
  void check_carried_wave(const std::string &name, double wavelength, double spacing,
                          const std::string &way_out);
} // namespace vibrocontact
