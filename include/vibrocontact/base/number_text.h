#pragma once

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
} // namespace vibrocontact
