#include <vibrocontact/output/answer_parts.h>

#include <cstdarg>
#include <cstdio>

namespace vibrocontact
{
  namespace answer_parts
  {
    std::string text(const char *const form, ...)
    {
      char line[400];
      va_list arguments;
      va_start(arguments, form);
      std::vsnprintf(line, sizeof line, form, arguments);
      va_end(arguments);
      return line;
    }

    double number(const Json &json, const std::string &name, const double otherwise)
    {
      const auto found = json.find(name);
      return found != json.end() && found->is_number() ? found->get<double>() : otherwise;
    }

    std::string word(const Json &json, const std::string &name)
    {
      const auto found = json.find(name);
      return found != json.end() && found->is_string() ? found->get<std::string>() : "";
    }

    const Json &list(const Json &json, const std::string &name)
    {
      static const Json none = Json::array();
      const auto found = json.find(name);
      return found != json.end() && found->is_array() ? *found : none;
    }

    bool is_given(const Json &json, const std::string &name)
    {
      return json.contains(name) && json[name].is_number();
    }

    void say_more(const std::size_t n, const std::string &what, Lines &lines)
    {
      if (n > most_said)
        lines.push_back(std::to_string(n - most_said) + " more " + what);
    }

    const Json *largest(const Json &entries, const std::string &name, const double sign)
    {
      const Json *best = nullptr;
      for (const Json &one : entries)
        if (!best || sign * number(one, name) > sign * number(*best, name))
          best = &one;
      return best;
    }
  } // namespace answer_parts
} // namespace vibrocontact
