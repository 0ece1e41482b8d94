#pragma once

#include <string>

namespace vibrocontact
{
  /// Ends the program after an error: rank 0 prints the message to standard error if all ranks failed (they
  /// usually do so together); a rank that failed alone prints its own and aborts the others, which would wait
  /// for ever.
  /// @return the exit code
  int leave_together(int exit_code, const std::string &message);
} // namespace vibrocontact
