#pragma once

#include <functional>
#include <string>

namespace vibrocontact
{
  /// An error as data, to be told to other ranks. InputError, MachineError, OutputError and ConvergenceError keep their
  /// class, anything else becomes a std::runtime_error.
  struct Failure
  {
    enum class Kind
    {
      none,
      input,
      machine,
      output,
      convergence,
      other
    };
    Kind kind = Kind::none;
    std::string text;

    explicit operator bool() const { return kind != Kind::none; }
    /// Throws it; returns if there is none.
    void rethrow() const;

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &kind &text;
    }
  };

  /// What an action throws.
  Failure failure_of(const std::function<void()> &action);
} // namespace vibrocontact
