#pragma once

#include <string>

namespace vibrocontact
{
  /// Place of the first byte that is no UTF-8 text; the length of the text if there is none.
  std::size_t first_byte_outside_utf8(const std::string &text);

  /// The beginning of a text, n bytes of it at most; no letter is cut.
  std::string first_letters(const std::string &text, std::size_t n);

  /// Text of a data file as UTF-8: what is none is taken for Latin-1, each byte a letter.
  std::string as_utf8(const std::string &text);
} // namespace vibrocontact
