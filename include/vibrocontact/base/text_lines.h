#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace vibrocontact
{
  /// The lines of a text one after the other, with their numbers for messages.
  class TextLines
  {
  public:
    /// @param source begins the messages, a file's name
    /// @param bytes UTF-8 or, if they are none, Latin-1 (base/utf8.h)
    TextLines(const std::string &source, const std::string &bytes);
    TextLines(const TextLines &) = delete;
    TextLines &operator=(const TextLines &) = delete;

    /// Goes to the next line. @return false at the end
    bool next();
    /// without its end, "\r\n" as well
    std::string_view line() const { return current; }
    /// from 1
    unsigned int number() const { return count; }
    /// "source, line 7"
    std::string where() const { return where(count); }
    std::string where(unsigned int number) const { return source + ", line " + std::to_string(number); }

  private:
    const std::string source, text;
    std::string_view current;
    std::size_t position = 0;
    unsigned int count = 0;
  };

  /// Takes the next word, between blanks, from the front of a text; empty at its end.
  std::string_view next_word(std::string_view &text);
  /// A word as a number: true if all of it is one, not finite ones included.
  bool is_number(std::string_view word, double &value);
  /// A word as a count.
  bool is_count(std::string_view word, unsigned long &value);
} // namespace vibrocontact
