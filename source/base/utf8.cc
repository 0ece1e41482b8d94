#include <vibrocontact/base/utf8.h>

namespace vibrocontact
{
  std::size_t first_byte_outside_utf8(const std::string &text)
  {
    const auto byte = [&](const std::size_t i) { return static_cast<unsigned char>(text[i]); };
    for (std::size_t i = 0; i < text.size();)
    {
      const unsigned char first = byte(i);
      const unsigned int n_more = first < 0x80                     ? 0
                                  : first >= 0xc2 && first <= 0xdf ? 1
                                  : first >= 0xe0 && first <= 0xef ? 2
                                  : first >= 0xf0 && first <= 0xf4 ? 3
                                                                   : 4;
      if (n_more == 4 || i + n_more >= text.size())
        return i;
      for (unsigned int k = 1; k <= n_more; ++k)
        if ((byte(i + k) & 0xc0) != 0x80)
          return i;
      // overlong forms, surrogates, beyond the last character
      const unsigned char second = n_more > 0 ? byte(i + 1) : 0;
      if ((first == 0xe0 && second < 0xa0) || (first == 0xed && second > 0x9f) ||
          (first == 0xf0 && second < 0x90) || (first == 0xf4 && second > 0x8f))
        return i;
      i += n_more + 1;
    }
    return text.size();
  }

  std::string first_letters(const std::string &text, const std::size_t n)
  {
    const std::string begin = text.substr(0, n);
    return begin.substr(0, first_byte_outside_utf8(begin));
  }

  std::string as_utf8(const std::string &text)
  {
    if (first_byte_outside_utf8(text) == text.size())
      return text;
    std::string result;
    for (const char c : text)
    {
      const auto byte = static_cast<unsigned char>(c);
      if (byte < 0x80)
        result += c;
      else
      {
        result += static_cast<char>(0xc0 | byte >> 6);
        result += static_cast<char>(0x80 | (byte & 0x3f));
      }
    }
    return result;
  }
} // namespace vibrocontact
