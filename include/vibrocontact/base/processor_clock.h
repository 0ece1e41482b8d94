#pragma once

#include <ctime>

namespace vibrocontact
{
  /// Processor time of the calling thread [s]: what a piece of work costs, whatever else runs on the machine.
  inline double processor_seconds()
  {
    timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return now.tv_sec + 1e-9 * now.tv_nsec;
  }
} // namespace vibrocontact
