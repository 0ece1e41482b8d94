#include <vibrocontact/base/text_lines.h>
#include <vibrocontact/base/utf8.h>

#include <algorithm>
#include <charconv>

namespace vibrocontact
{
  TextLines::TextLines(const std::string &source, const std::string &bytes)
      : source(source), text(as_utf8(bytes))
  {
  }

  bool TextLines::next()
  {
    if (position >= text.size())
      return false;
    const std::size_t end = std::min(text.find('\n', position), text.size());
    current = std::string_view(text).substr(position, end - position);
    if (!current.empty() && current.back() == '\r')
      current.remove_suffix(1);
    position = end + 1;
    ++count;
    return true;
  }

  std::string_view next_word(std::string_view &text)
  {
    const std::size_t first = std::min(text.find_first_not_of(" \t"), text.size()),
                      end = std::min(text.find_first_of(" \t", first), text.size());
    const std::string_view word = text.substr(first, end - first);
    text.remove_prefix(end);
    return word;
  }

  bool is_number(std::string_view word, double &value)
  {
    if (word.size() > 1 && word[0] == '+')
      word.remove_prefix(1);
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return !word.empty() && error == std::errc() && end == word.data() + word.size();
  }

  bool is_count(const std::string_view word, unsigned long &value)
  {
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return !word.empty() && error == std::errc() && end == word.data() + word.size();
  }
} // namespace vibrocontact
