#include <vibrocontact/numerics/frequency_refinement.h>

#include <algorithm>
#include <cmath>
#include <complex>

namespace vibrocontact
{
  namespace
  {
    constexpr double least_bend = 5e-3;

    using Receptance = std::vector<std::complex<double>>;

    /// At each frequency the largest over the driving points; none at the first and the last.
    std::vector<double> bends(const std::vector<double> &frequency, const std::vector<Receptance> &receptance)
    {
      std::vector<double> bend(frequency.size());
      if (frequency.empty())
        return bend;
      const unsigned int n = std::lround(std::sqrt(receptance.front().size()));
      for (std::size_t k = 1; k + 1 < frequency.size(); ++k)
        for (unsigned int i = 0; i < n; ++i)
        {
          const auto level = [&](const std::size_t at)
          { return std::log(std::abs(receptance[at][i * n + i])); };
          const double share =
              std::log(frequency[k] / frequency[k - 1]) / std::log(frequency[k + 1] / frequency[k - 1]);
          bend[k] = std::max(bend[k], std::abs(level(k) - (1 - share) * level(k - 1) - share * level(k + 1)));
        }
      return bend;
    }
  } // namespace

  std::vector<double> frequencies_between(const std::vector<double> &frequency,
                                          const std::vector<Receptance> &receptance,
                                          const unsigned int n_most)
  {
    const std::vector<double> bend = bends(frequency, receptance);
    struct Interval
    {
      /// bend times width
      double area, middle;
    };
    std::vector<Interval> intervals;
    for (std::size_t k = 0; k + 1 < frequency.size(); ++k)
      if (const double larger = std::max(bend[k], bend[k + 1]); larger > least_bend)
        intervals.push_back(
            {larger * std::log(frequency[k + 1] / frequency[k]), std::sqrt(frequency[k] * frequency[k + 1])});
    std::stable_sort(intervals.begin(), intervals.end(),
                     [](const Interval &a, const Interval &b) { return a.area > b.area; });
    std::vector<double> result;
    for (std::size_t k = 0; k < std::min<std::size_t>(n_most, intervals.size()); ++k)
      result.push_back(intervals[k].middle);
    std::sort(result.begin(), result.end());
    return result;
  }
} // namespace vibrocontact
