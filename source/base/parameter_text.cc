#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/nearest_names.h>
#include <vibrocontact/base/parameter_text.h>
#include <vibrocontact/base/utf8.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>
#include <utility>

namespace vibrocontact
{
  std::string trimmed(const std::string &text)
  {
    const char *blanks = " \t\r\n";
    const std::size_t first = text.find_first_not_of(blanks);
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blanks) - first + 1);
  }

  std::string lower_case(const std::string_view text)
  {
    std::string result(text);
    for (char &c : result)
      c = std::tolower(static_cast<unsigned char>(c));
    return result;
  }

  std::vector<std::string> split_list(const std::string &text)
  {
    std::vector<std::string> members;
    std::istringstream stream(text);
    for (std::string member; std::getline(stream, member, ',');)
      if (!trimmed(member).empty())
        members.push_back(trimmed(member));
    return members;
  }

  std::optional<double> finite_number(const std::string &word)
  {
    try
    {
      std::size_t used = 0;
      const double value = std::stod(word, &used);
      if (used == word.size() && std::isfinite(value))
        return value;
    }
    catch (const std::exception &)
    {
    }
    return {};
  }

  std::string section_text(const std::string &path)
  {
    return path.empty() ? "the top level" : "section " + path;
  }

  std::string joined_path(const std::string &section, const std::string &name)
  {
    return section.empty() ? name : section + "/" + name;
  }

  const ParameterText::Entry *ParameterText::find(const std::string &section, const std::string &name) const
  {
    const auto found = std::find_if(entries.begin(), entries.end(),
                                    [&](const Entry &e) { return e.section == section && e.name == name; });
    return found == entries.end() ? nullptr : &*found;
  }

  bool ParameterText::has_section(const std::string &path) const
  {
    return std::any_of(sections.begin(), sections.end(), [&](const Section &s) { return s.path == path; });
  }

  namespace
  {
    struct OpenSection
    {
      std::string name, path;
      unsigned int line;
      std::size_t indentation;
    };

    /// First word of a line and what follows it.
    std::pair<std::string, std::string> first_word(const std::string &line)
    {
      const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
      return {line.substr(0, end), trimmed(line.substr(end))};
    }

    std::string one_spaced(const std::string &text)
    {
      std::istringstream stream(text);
      std::string result;
      for (std::string word; stream >> word;)
        result += (result.empty() ? "" : " ") + word;
      return result;
    }
  } // namespace

  ParameterText scan_parameter_text(const std::string &file_name, const std::string &bytes)
  {
    ParameterText text;
    text.file_name = file_name;
    text.bytes = bytes;
    const auto at = [&](const unsigned int line) { return file_name + ":" + std::to_string(line) + ": "; };

    const std::size_t zero = bytes.find('\0');
    if (zero != std::string::npos)
      throw InputError(at(1 + std::count(bytes.begin(), bytes.begin() + zero, '\n')) +
                       "this is not a text file; give a parameter file (.prm)");
    const std::size_t strange = first_byte_outside_utf8(bytes);
    if (strange < bytes.size())
    {
      const std::size_t begin = strange == 0 ? 0 : bytes.rfind('\n', strange - 1) + 1;
      throw InputError(at(1 + std::count(bytes.begin(), bytes.begin() + strange, '\n')) +
                       "a letter after \"" + trimmed(bytes.substr(begin, strange - begin)) +
                       "\" is not written in UTF-8 (an umlaut in Latin-1?); save the file as UTF-8, for "
                       "instance by iconv -f latin1 -t utf-8");
    }

    std::vector<OpenSection> open;
    // A subsection that begins no further right than the one around it hints at the "end" that was forgotten.
    std::string missing_end;

    // Editors put a byte-order mark in front of UTF-8; it means nothing here.
    const std::string mark = "\xef\xbb\xbf";
    std::istringstream stream(bytes.compare(0, mark.size(), mark) == 0 ? bytes.substr(mark.size()) : bytes);
    unsigned int line_number = 0;
    for (std::string raw; std::getline(stream, raw);)
    {
      const unsigned int first_line = ++line_number;
      const std::size_t indentation = std::min(raw.find_first_not_of(" \t"), raw.size());
      std::string line = trimmed(raw.substr(0, raw.find('#')));
      while (!line.empty() && line.back() == '\\')
      {
        line.pop_back();
        if (!std::getline(stream, raw))
          break;
        ++line_number;
        line = trimmed(line) + " " + trimmed(raw.substr(0, raw.find('#')));
      }
      if (line.empty())
        continue;

      const auto [keyword, rest] = first_word(line);
      const std::string here = open.empty() ? "" : open.back().path;
      if (keyword == "subsection" && !rest.empty())
      {
        const std::string name = one_spaced(rest);
        if (name.find('/') != std::string::npos)
          throw InputError(at(first_line) + "the name of subsection \"" + name +
                           "\" contains a slash; put one subsection into the other instead");
        if (!open.empty() && indentation <= open.back().indentation && missing_end.empty())
          missing_end = at(open.back().line) + "subsection \"" + open.back().name +
                        "\" is never closed; add a line \"end\" before line " + std::to_string(first_line);
        open.push_back({name, joined_path(here, name), first_line, indentation});
        if (!text.has_section(open.back().path))
          text.sections.push_back({open.back().path, first_line});
      }
      else if (keyword == "end" && rest.empty())
      {
        if (open.empty())
          throw InputError(at(first_line) +
                           "this \"end\" closes nothing, every subsection before it is closed " +
                           "already; remove it or add the missing line \"subsection ...\"");
        open.pop_back();
      }
      else if (keyword == "set")
      {
        const std::size_t equals = rest.find('=');
        const std::string name = one_spaced(rest.substr(0, equals));
        if (equals == std::string::npos || name.empty())
          throw InputError(at(first_line) + "\"" + line + "\" sets nothing; write \"set Entry = value\"");
        if (const auto *before = text.find(here, name))
          throw InputError(at(first_line) + "entry \"" + name + "\" of " + section_text(here) +
                           " is set a second time, after line " + std::to_string(before->line) +
                           "; keep one of the two lines");
        text.entries.push_back({here, name, trimmed(rest.substr(equals + 1)), first_line});
      }
      else if (keyword == "include")
        throw InputError(at(first_line) + "include is not supported; copy the lines of that file to here");
      else
        throw InputError(
            at(first_line) + "cannot read the line \"" + first_letters(line, 60) + "\"; " +
            (line.find('=') != std::string::npos && nearest_names(keyword, {"set"}).empty()
                 ? "write \"set\" in front of it"
                 : "a line is \"set Entry = value\", \"subsection Name\", \"end\" or a comment after #"));
    }
    if (!open.empty())
      throw InputError(!missing_end.empty() ? missing_end
                                            : at(open.back().line) + "subsection \"" + open.back().name +
                                                  "\" is never closed; add a line \"end\" after its entries");
    return text;
  }
} // namespace vibrocontact
