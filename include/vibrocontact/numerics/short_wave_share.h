#pragma once

#include <functional>

namespace vibrocontact
{
  /// What points at equal distances cannot carry of a height over the position: the part of it in waves shorter than two
  /// spacings, root mean square over that of the height about its mean [-]; 1 for one short sine. It is the
  /// largest of up to eight stretches of 256 spacings over the way (a shorter way lies in its middle), each sampled 64 times per spacing and cut there
  /// (resampled()). A step or a kink has some of it, a few percent.
  /// @param spacing [m] @return 0 of a height that is not finite somewhere there, or flat
  double short_wave_share(const std::function<double(double)> &height, double begin, double end,
                          double spacing);
} // namespace vibrocontact
