#pragma once

#include <chrono>

namespace vibrocontact
{
  using WallClock = std::chrono::steady_clock;

  /// [s]
  inline double seconds_since(const WallClock::time_point begin)
  {
    return std::chrono::duration<double>(WallClock::now() - begin).count();
  }
} // namespace vibrocontact
