#include <vibrocontact/numerics/short_wave_share.h>
#include <vibrocontact/numerics/signal.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// Sums of squares of the short waves and of the whole, over the inside of a stretch.
    struct Squares
    {
      double of_short = 0, of_all = 0;
    };

    Squares squares(Signal height, const double spacing)
    {
      // zero at both ends, beyond which it is taken as zero
      const double first = height.values.front(), rise = height.values.back() - first;
      const std::size_t last = height.size() - 1;
      for (std::size_t i = 0; i <= last; ++i)
        height.values[i] -= first + rise * i / last;
      const Signal long_waves = resampled(resampled(height, 1 / spacing), 1 / height.step);
      // the ends ring
      const std::size_t edge = std::llround(8 * spacing / height.step),
                        end = std::min(height.size(), long_waves.size()) - edge;
      double mean = 0;
      for (std::size_t i = edge; i < end; ++i)
        mean += (height.values[i] + first + rise * i / last) / (end - edge);
      Squares result;
      for (std::size_t i = edge; i < end; ++i)
      {
        result.of_short += std::pow(height.values[i] - long_waves.values[i], 2);
        result.of_all += std::pow(height.values[i] + first + rise * i / last - mean, 2);
      }
      return result;
    }
  } // namespace

  double short_wave_share(const std::function<double(double)> &height, const double begin, const double end,
                          const double spacing)
  {
    constexpr unsigned int most_stretches = 8, spacings = 256, samples_per_spacing = 64;
    const double length = spacings * spacing;
    const unsigned int n = std::min<double>(most_stretches, std::max(1., std::ceil((end - begin) / length)));
    Squares largest;
    for (unsigned int k = 0; k < n; ++k)
    {
      Signal stretch;
      stretch.begin = n > 1 ? begin + k * (end - begin - length) / (n - 1) : 0.5 * (begin + end - length);
      stretch.step = spacing / samples_per_spacing;
      for (unsigned int i = 0; i <= spacings * samples_per_spacing; ++i)
        stretch.values.push_back(height(stretch.time(i)));
      if (!std::all_of(stretch.values.begin(), stretch.values.end(),
                       [](const double value) { return std::isfinite(value); }))
        continue;
      const Squares own = squares(stretch, spacing);
      largest.of_short = std::max(largest.of_short, own.of_short);
      largest.of_all = std::max(largest.of_all, own.of_all);
    }
    // heights below the size of an atom are rounding
    return largest.of_all > 1e-24 ? std::sqrt(largest.of_short / largest.of_all) : 0;
  }
} // namespace vibrocontact
