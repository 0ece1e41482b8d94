#pragma once

#include <stdexcept>
#include <string>

namespace vibrocontact
{
  /// Wrong input: one sentence that says what is wrong, where (file, line, section, entry) and what to do.
  /// main() prints it alone and leaves with exit code 1.
  class InputError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /// Results that cannot be written (full disk, lost permission): one sentence. What was written so far is
  /// kept; exit code 3.
  class OutputError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /// A computation that did not converge. What was computed so far is kept and marked; exit code 2.
  class ConvergenceError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };
} // namespace vibrocontact
