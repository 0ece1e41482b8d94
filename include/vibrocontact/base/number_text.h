#pragma once

#include <cmath>
#include <cstdio>
#include <string>

namespace vibrocontact
{
  /// A number for a message, six significant digits: 1e-10 where std::to_string has 0.000000.
  inline std::string number_text(const double number)
  {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", number);
    return text;
  }

  /// A share in percent for a message, two significant digits; from 100 to a million all digits before the point.
  inline std::string percent_text(const double share)
  {
    const double size = std::abs(100 * share);
    char text[32];
    std::snprintf(text, sizeof text, size >= 99.5 && size < 1e6 ? "%.0f %%" : "%.2g %%", 100 * share);
    return text;
  }

  /// The same rounded to so many digits behind the point.
  inline std::string percent_text(const double share, const unsigned int n_decimals)
  {
    const double scale = std::pow(10, n_decimals);
    return number_text(std::round(100 * scale * share) / scale) + " %";
  }
} // namespace vibrocontact
