#include <vibrocontact/receptances/si_label.h>

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
        {"kg", {{1, 0, 0}}},     {"1", {{0, 0, 0}}}};

    /// Small letters; superscripts become powers, dots on the line asterisks.
    std::string in_letters(const std::string &label)
    {
      const std::vector<std::pair<std::string, std::string>> signs = {
          {"\u207b", "-"}, {"\u00b9", "1"}, {"\u00b2", "2"}, {"\u00b3", "3"},
          {"\u00b7", "*"}, {"\u22c5", "*"}, {"**", "^"}};
      std::string text = label;
      for (const auto &[sign, letters] : signs)
        for (std::size_t at; (at = text.find(sign)) != std::string::npos;)
          text.replace(at, sign.size(), letters);
      for (char &c : text)
        c = c == '.' ? '*' : std::tolower(static_cast<unsigned char>(c));
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

      /// units without anything between them, the last one with a power, or brackets
      std::optional<SiPowers> factor()
      {
        if (take('('))
        {
          const std::optional<SiPowers> inside = product();
          if (!inside || !take(')'))
            return {};
          return times(*inside, power());
        }
        SiPowers sum{};
        bool any = false;
        for (std::optional<SiPowers> one; (one = name());)
        {
          any = true;
          const SiPowers raised = times(*one, power());
          for (unsigned int k = 0; k < 3; ++k)
            sum[k] += raised[k];
        }
        return any ? std::optional<SiPowers>(sum) : std::nullopt;
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

      int power()
      {
        const std::size_t begin = at;
        const bool raised = at < text.size() && text[at] == '^' && ++at > 0,
                   in_brackets = raised && at < text.size() && text[at] == '(' && ++at > 0;
        int sign = 1;
        if (at < text.size() && (text[at] == '-' || text[at] == '+'))
          sign = text[at++] == '-' ? -1 : 1;
        if (at == text.size() || !std::isdigit(static_cast<unsigned char>(text[at])))
        {
          at = begin;
          return 1;
        }
        const int result = sign * (text[at++] - '0');
        if (in_brackets && at < text.size() && text[at] == ')')
          ++at;
        return result;
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
