#include <vibrocontact/base/parameter_text.h>
#include <vibrocontact/receptances/si_label.h>

#include <algorithm>
#include <cctype>
#include <utility>
#include <vector>

namespace vibrocontact
{
  namespace
  {
    /// longer names before those that they begin with
    const std::vector<std::pair<std::string, SiPowers>> names = {
        {"metres", {{0, 1, 0}}}, {"meters", {{0, 1, 0}}},   {"metre", {{0, 1, 0}}},
        {"meter", {{0, 1, 0}}},  {"m", {{0, 1, 0}}},        {"seconds", {{0, 0, 1}}},
        {"second", {{0, 0, 1}}}, {"secs", {{0, 0, 1}}},     {"sec", {{0, 0, 1}}},
        {"s", {{0, 0, 1}}},      {"newtons", {{1, 1, -2}}}, {"newton", {{1, 1, -2}}},
        {"n", {{1, 1, -2}}},     {"hertz", {{0, 0, -1}}},   {"hz", {{0, 0, -1}}},
        {"kg", {{1, 0, 0}}}};

    /// Small letters; superscripts become powers, dots on the line asterisks.
    std::string in_letters(const std::string &label)
    {
      const std::vector<std::pair<std::string, std::string>> signs = {
          {"\u207b", "-"}, {"\u00b9", "1"}, {"\u00b2", "2"}, {"\u00b3", "3"},
          {"\u00b7", "*"}, {"\u22c5", "*"}, {"**", "^"}};
      std::string text = lower_case(label);
      for (const auto &[sign, letters] : signs)
        for (std::size_t at; (at = text.find(sign)) != std::string::npos;)
          text.replace(at, sign.size(), letters);
      std::replace(text.begin(), text.end(), '.', '*');
      return text;
    }

    /// Reads a label from left to right.
    class LabelReader
    {
    public:
      explicit LabelReader(const std::string &text) : text(text) {}

      std::optional<SiPowers> whole()
      {
        const std::optional<SiPowers> found = product();
        return found && at == text.size() ? found : std::nullopt;
      }

    private:
      void skip(const char what)
      {
        while (at < text.size() && text[at] == what)
          ++at;
      }
      bool take(const char what)
      {
        skip(' ');
        if (at == text.size() || text[at] != what)
          return false;
        ++at;
        return true;
      }

      /// up to the end or a closing bracket
      std::optional<SiPowers> product()
      {
        SiPowers sum{};
        int sign = 1;
        do
        {
          const std::optional<SiPowers> one = factor();
          if (!one)
            return {};
          for (unsigned int k = 0; k < 3; ++k)
            sum[k] += sign * (*one)[k];
          sign = take('/') ? -1 : 1;
          if (sign == 1)
            take('*');
          skip(' ');
        } while (sign == -1 || (at < text.size() && text[at] != ')'));
        return sum;
      }

      /// 1, brackets, or units without anything between them, the last one with a power
      std::optional<SiPowers> factor()
      {
        if (take('('))
        {
          const std::optional<SiPowers> inside = product();
          if (!inside || !take(')'))
            return {};
          return raised(*inside);
        }
        if (at < text.size() && text[at] == '1')
        {
          ++at;
          return at < text.size() && std::isalnum(static_cast<unsigned char>(text[at]))
                     ? std::nullopt
                     : std::optional<SiPowers>(SiPowers{});
        }
        SiPowers sum{};
        bool any = false, after_metre = false;
        while (at < text.size() && std::isalpha(static_cast<unsigned char>(text[at])))
        {
          const std::optional<SiPowers> unit = name(), one = unit ? raised(*unit) : std::nullopt;
          // "ms" may be a thousandth of a second, "ms^-2" is none
          if (!one || (after_metre && !is_negative(*unit, *one)))
            return {};
          after_metre = *one == SiPowers{{0, 1, 0}};
          any = true;
          for (unsigned int k = 0; k < 3; ++k)
            sum[k] += (*one)[k];
        }
        return any ? std::optional<SiPowers>(sum) : std::nullopt;
      }

      static bool is_negative(const SiPowers &unit, const SiPowers &raised)
      {
        for (unsigned int k = 0; k < 3; ++k)
          if (unit[k] != 0)
            return raised[k] / unit[k] < 0;
        return false;
      }

      std::optional<SiPowers> name()
      {
        for (const auto &[word, powers] : names)
          if (text.compare(at, word.size(), word) == 0)
          {
            at += word.size();
            return powers;
          }
        return {};
      }

      /// Powers times the one digit that follows, if any does; nothing: what follows is no power.
      std::optional<SiPowers> raised(const SiPowers &powers)
      {
        const auto is_digit = [&]
        { return at < text.size() && std::isdigit(static_cast<unsigned char>(text[at])); };
        const auto is_next = [&](const char c) { return at < text.size() && text[at] == c; };
        const auto take_next = [&](const char c) { return is_next(c) && ++at > 0; };
        const bool has_sign_of_power = take_next('^'), in_brackets = has_sign_of_power && take_next('(');
        const bool negative = take_next('-');
        if (!negative)
          take_next('+');
        if (!is_digit())
          return has_sign_of_power || negative ? std::nullopt : std::optional<SiPowers>(powers);
        const int power = (negative ? -1 : 1) * (text[at++] - '0');
        if (is_digit() || (in_brackets && !take_next(')')))
          return {};
        return times(powers, power);
      }

      static SiPowers times(SiPowers powers, const int factor)
      {
        for (int &power : powers)
          power *= factor;
        return powers;
      }

      const std::string &text;
      std::size_t at = 0;
    };
  } // namespace

  std::optional<SiPowers> si_powers(const std::string &label)
  {
    const std::string text = in_letters(label);
    return LabelReader(text).whole();
  }
} // namespace vibrocontact
