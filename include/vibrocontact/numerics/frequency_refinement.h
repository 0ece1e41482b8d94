#pragma once

#include <complex>
#include <vector>

namespace vibrocontact
{
  /// Where further frequencies show most of a response: in the middle (geometric mean) of the intervals where the straight
  /// lines through the values so far miss the largest area. A frequency's bend is the distance of log |H_ii| from the
  /// straight line, over log f, between the values at its two neighbours: nearly nothing on slopes, large at resonances
  /// and antiresonances, whatever the level. The larger bend of its ends times its width in log f ranks an interval;
  /// those that bend by less than 0.5 % at both ends are left alone.
  ///
  /// @param frequency [Hz] ascending, positive; @param receptance n x n matrix at each of them
  /// @param n_most at most that many are returned
  /// @return [Hz] ascending, between the given ones; empty if the response is smooth
  std::vector<double> frequencies_between(const std::vector<double> &frequency,
                                          const std::vector<std::vector<std::complex<double>>> &receptance,
                                          unsigned int n_most);
} // namespace vibrocontact
