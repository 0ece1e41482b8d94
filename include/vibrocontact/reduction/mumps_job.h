#pragma once

#include <vibrocontact/base/exceptions.h>

#include <algorithm>
#include <string>

namespace vibrocontact
{
  /// Runs one job of MUMPS on `mumps` by `call`, e.g. dmumps_c(). Collective.
  ///
  /// MUMPS sizes the workspace of a factorisation by its analysis and a margin (ICNTL(14)). What pivots and the order
  /// of messages between ranks ask beyond it is not known before: a factorisation that ends for want of workspace or
  /// of a buffer (MUMPS 5.5 users' guide, section 8: INFOG(1) = -8, -9, -17 or -20) is repeated with a larger
  /// margin, up to `largest_margin`.
  /// @param[in] what  of what, for the message, e.g. "factorisation of a matrix of 1323 dofs"
  /// @throws ConvergenceError with the codes of MUMPS.
  template <typename Mumps>
  void run_mumps(Mumps &mumps, void (*call)(Mumps *), const int job, const std::string &what)
  {
    constexpr int factorisation = 2, largest_margin = 500; // of the workspace [%]
    auto &margin = mumps.icntl[14 - 1];
    int info = 0;
    const auto run = [&]()
    {
      mumps.job = job;
      call(&mumps);
      info = mumps.infog[1 - 1];
    };
    run();
    while (job == factorisation && (info == -8 || info == -9 || info == -17 || info == -20) &&
           margin < largest_margin)
    {
      margin = std::min(largest_margin, 2 * std::max<int>(margin, 0) + 20);
      run();
    }
    if (info < 0)
      throw ConvergenceError("MUMPS failed in the " + what + ": INFOG(1) = " + std::to_string(info) +
                             ", INFOG(2) = " + std::to_string(mumps.infog[2 - 1]) +
                             (info == -10 ? " (the matrix is singular: is the body held?)."
                              : info == -9 || info == -13 || info == -19 ? " (not enough memory)."
                                                                         : "."));
  }
} // namespace vibrocontact
