#pragma once

#include <functional>

namespace vibrocontact
{
  /// Asks a LAPACK function for the work it needs, then runs it.
  /// @param name for the message @throws ConvergenceError if its info is not zero
  void with_work(const char *name,
                 const std::function<void(double *work, const int &n_work, int &info)> &call);
} // namespace vibrocontact
