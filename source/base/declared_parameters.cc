#include <vibrocontact/base/declared_parameters.h>
#include <vibrocontact/base/parameter_text.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

namespace vibrocontact
{
  namespace
  {
    void collect(const nlohmann::ordered_json &node, const std::string &path, DeclaredParameters &result)
    {
      result.sections.push_back(path);
      for (const auto &[key, child] : node.items())
        if (child.is_object() && child.contains("value") && child["value"].is_string())
          result.entries.push_back({path, key, child.value("value", ""), child.value("default_value", ""),
                                    child.value("documentation", ""),
                                    child.value("pattern_description", "")});
      for (const auto &[key, child] : node.items())
        if (child.is_object() && !(child.contains("value") && child["value"].is_string()) &&
            !child.contains("alias"))
          collect(child, joined_path(path, key), result);
    }

    bool is_child(const std::string &path, const std::string &parent)
    {
      const std::string start = parent.empty() ? "" : parent + "/";
      return !path.empty() && path.size() > start.size() && path.compare(0, start.size(), start) == 0 &&
             path.find('/', start.size()) == std::string::npos;
    }

    /// "0...MAX_DOUBLE (inclusive)" -> "of at least 0"; the bounds of a range in words.
    std::string range_in_words(const std::string &range)
    {
      const std::size_t dots = range.find("...");
      if (dots == std::string::npos)
        return "";
      const std::string low = trimmed(range.substr(0, dots));
      const std::string high = trimmed(range.substr(dots + 3, range.find('(') - dots - 3));
      const bool has_low = low.find("MAX") == std::string::npos && low != "-2147483648";
      const bool has_high =
          high.find("MAX") == std::string::npos && high != "2147483647" && high != "4294967295";
      const bool tiny =
          has_low && std::strtod(low.c_str(), nullptr) > 0 && std::strtod(low.c_str(), nullptr) < 1e-100;
      if (tiny)
        return has_high ? " above 0 and up to " + high : " greater than 0";
      if (has_low && has_high)
        return " from " + low + " to " + high;
      if (has_low)
        return " of at least " + low;
      return has_high ? " of at most " + high : "";
    }
  } // namespace

  const DeclaredParameters::Entry *DeclaredParameters::find(const std::string &section,
                                                            const std::string &name) const
  {
    const auto found = std::find_if(entries.begin(), entries.end(),
                                    [&](const Entry &e) { return e.section == section && e.name == name; });
    return found == entries.end() ? nullptr : &*found;
  }

  DeclaredParameters::Entry *DeclaredParameters::find(const std::string &section, const std::string &name)
  {
    return const_cast<Entry *>(std::as_const(*this).find(section, name));
  }

  bool DeclaredParameters::has_section(const std::string &path) const
  {
    return std::find(sections.begin(), sections.end(), path) != sections.end();
  }

  DeclaredParameters DeclaredParameters::without(const std::vector<std::string> &paths) const
  {
    DeclaredParameters result = *this;
    result.entries.erase(std::remove_if(result.entries.begin(), result.entries.end(),
                                        [&](const Entry &entry) {
                                          return std::count(paths.begin(), paths.end(),
                                                            joined_path(entry.section, entry.name)) > 0;
                                        }),
                         result.entries.end());
    return result;
  }

  std::vector<std::string> DeclaredParameters::entry_names(const std::string &section) const
  {
    std::vector<std::string> names;
    for (const auto &entry : entries)
      if (entry.section == section)
        names.push_back(entry.name);
    return names;
  }

  std::vector<std::string> DeclaredParameters::subsection_names(const std::string &section) const
  {
    std::vector<std::string> names;
    for (const auto &path : sections)
      if (is_child(path, section))
        names.push_back(path.substr(section.empty() ? 0 : section.size() + 1));
    return names;
  }

  DeclaredParameters declared_parameters(const dealii::ParameterHandler &prm)
  {
    std::ostringstream json;
    prm.print_parameters(json,
                         dealii::ParameterHandler::KeepDeclarationOrder | dealii::ParameterHandler::JSON);
    DeclaredParameters result;
    collect(nlohmann::ordered_json::parse(json.str()), "", result);
    return result;
  }

  std::string pattern_in_words(const std::string &pattern)
  {
    const auto starts = [&](const std::string &text) { return pattern.compare(0, text.size(), text) == 0; };
    const std::string inside = pattern.size() > 2 ? pattern.substr(1, pattern.size() - 2) : "";
    if (starts("[Double"))
      return "a number" + range_in_words(inside.substr(6));
    if (starts("[Integer"))
      return "a whole number" + range_in_words(inside.compare(0, 13, "Integer range") == 0
                                                   ? inside.substr(13)
                                                   : inside.substr(7));
    if (starts("[Bool"))
      return "true or false";
    if (starts("[Selection") || starts("[MultipleSelection"))
    {
      std::string names = trimmed(inside.substr(inside.find(' ')));
      std::string text;
      std::istringstream stream(names);
      for (std::string name; std::getline(stream, name, '|');)
        text += (text.empty() ? "" : ", ") + trimmed(name);
      return (starts("[Selection") ? "one of: " : "a list out of: ") + text;
    }
    if (starts("[List of"))
    {
      const std::size_t begin = pattern.find('<'), end = pattern.rfind('>');
      const std::string member = pattern_in_words(pattern.substr(begin + 1, end - begin - 1));
      const std::string length = pattern.substr(end);
      if (length.find(" 0...1 ") != std::string::npos)
        return "empty or " + member;
      const std::size_t dots = length.find("...");
      const std::size_t from = length.find("length ") + 7;
      const std::string least = length.substr(from, dots - from);
      return "a list, separated by commas," + (least == "0" ? "" : " at least " + least + " long,") + " of " +
             member;
    }
    if (starts("[FileName"))
      return "a file name";
    if (starts("[DirectoryName"))
      return "a folder name";
    if (starts("[Anything"))
      return "a text";
    return inside;
  }

  std::string unit_of(const std::string &documentation)
  {
    const std::size_t begin = documentation.rfind("Units:");
    if (begin == std::string::npos)
      return "";
    std::string unit = trimmed(documentation.substr(begin + 6));
    while (!unit.empty() && unit.back() == '.')
      unit.pop_back();
    return unit == "none" ? "" : unit;
  }

  std::string print_parameters(const DeclaredParameters &parameters, const ParameterStyle style)
  {
    std::ostringstream out;
    const auto wrapped = [&](const std::string &text, const std::string &indent)
    {
      std::istringstream stream(text);
      std::string line = indent + "#";
      for (std::string word; stream >> word;)
      {
        if (line.size() + word.size() + 1 > 110)
        {
          out << line << '\n';
          line = indent + "#";
        }
        line += " " + word;
      }
      out << line << '\n';
    };
    const auto print_section = [&](const auto &self, const std::string &path,
                                   const std::string &indent) -> void
    {
      bool first = true;
      for (const auto &entry : parameters.entries)
        if (entry.section == path)
        {
          if (style == ParameterStyle::documented)
          {
            if (!first)
              out << '\n';
            wrapped(entry.documentation, indent);
            wrapped("Value: " + pattern_in_words(entry.pattern) +
                        ". Default: " + (entry.default_value.empty() ? "empty" : entry.default_value) + ".",
                    indent);
          }
          first = false;
          out << indent << "set " << entry.name << " =" << (entry.value.empty() ? "" : " ") << entry.value
              << '\n';
        }
      for (const auto &name : parameters.subsection_names(path))
      {
        out << (style == ParameterStyle::documented && path.empty() ? "\n\n" : "\n");
        out << indent << "subsection " << name << '\n';
        self(self, joined_path(path, name), indent + "  ");
        out << indent << "end\n";
      }
    };
    print_section(print_section, "", "");
    return out.str();
  }
} // namespace vibrocontact
