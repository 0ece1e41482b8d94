#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/nearest_names.h>
#include <vibrocontact/base/parameter_file.h>
#include <vibrocontact/base/run_communicator.h>
#include <vibrocontact/base/utf8.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

namespace vibrocontact
{
  namespace
  {
    std::pair<std::string, std::string> split_path(const std::string &path)
    {
      const std::size_t slash = path.rfind('/');
      if (slash == std::string::npos)
        return {"", trimmed(path)};
      return {trimmed(path.substr(0, slash)), trimmed(path.substr(slash + 1))};
    }

    /// A number that is not finite, such as nan, inf or 1e999, among the words of a value.
    std::string not_finite_word(const std::string &value)
    {
      std::string words = value;
      std::replace_if(
          words.begin(), words.end(), [](const char c) { return c == ',' || c == ';' || c == ':'; }, ' ');
      std::istringstream stream(words);
      for (std::string word; stream >> word;)
      {
        char *end = nullptr;
        const double number = std::strtod(word.c_str(), &end);
        if (end != word.c_str() && *end == '\0' && !std::isfinite(number))
          return word;
      }
      return "";
    }

    /// Sets an entry; false if its pattern or its variable refuses the value.
    bool set_value(dealii::ParameterHandler &prm, const ParameterText::Entry &entry)
    {
      std::vector<std::string> levels;
      std::istringstream stream(entry.section);
      for (std::string level; std::getline(stream, level, '/');)
        levels.push_back(level);
      for (const auto &level : levels)
        prm.enter_subsection(level);
      bool good = true;
      try
      {
        prm.set(entry.name, entry.value);
      }
      catch (const std::exception &)
      {
        good = false;
      }
      for (std::size_t i = 0; i < levels.size(); ++i)
        prm.leave_subsection();
      return good;
    }

    /// Sections other than this one that know an entry of this name, as a hint.
    std::string elsewhere(const DeclaredParameters &declared, const ParameterText::Entry &entry)
    {
      std::vector<std::string> homes;
      for (const auto &candidate : declared.entries)
        if (candidate.name == entry.name)
          homes.push_back(candidate.section.empty() ? "the top level" : candidate.section);
      if (homes.empty() || homes.size() > 4)
        return "";
      return "; an entry of this name belongs to " + quoted_list(homes);
    }

    void check_section(const DeclaredParameters &declared, const std::string &path,
                       const std::string &location)
    {
      if (declared.has_section(path))
        return;
      const auto [parent, name] = split_path(path);
      check_section(declared, parent, location);
      throw InputError(location + section_text(parent) + " has no subsection \"" + name + "\"; " +
                       name_suggestion(name, declared.subsection_names(parent)) +
                       (parent.empty() ? " (a body's section has to be listed in the entry Bodies)" : ""));
    }

    void check_name(const DeclaredParameters &declared, const ParameterText::Entry &entry,
                    const std::string &location)
    {
      check_section(declared, entry.section, location);
      if (declared.find(entry.section, entry.name))
        return;
      const std::vector<std::string> names = declared.entry_names(entry.section);
      const std::string other = elsewhere(declared, entry);
      throw InputError(location + section_text(entry.section) + " has no entry \"" + entry.name + "\"" +
                       (nearest_names(entry.name, names).empty() && !other.empty()
                            ? other
                            : "; " + name_suggestion(entry.name, names)));
    }
  } // namespace

  ParameterFile::ParameterFile(const std::string &file_name, const std::string &bytes,
                               const std::vector<std::string> &overrides)
      : text(scan_parameter_text(file_name, bytes))
  {
    for (const auto &option : overrides)
    {
      if (first_byte_outside_utf8(option) < option.size())
        throw InputError(
            "--set \"" + option.substr(0, first_byte_outside_utf8(option)) +
            "...\" holds a letter that is not written in UTF-8; write it in a terminal of UTF-8");
      const std::size_t equals = option.find('=');
      const auto [section, name] = split_path(option.substr(0, equals));
      if (equals == std::string::npos || name.empty())
        throw InputError("--set \"" + option +
                         "\" names no entry or no value; write --set \"Section/Sub/Entry=value\"");
      options.erase(std::remove_if(options.begin(), options.end(),
                                   [&, section = section, name = name](const ParameterText::Entry &e)
                                   { return e.section == section && e.name == name; }),
                    options.end());
      options.push_back({section, name, trimmed(option.substr(equals + 1)), 0});
    }
  }

  const ParameterText::Entry *ParameterFile::find_option(const std::string &section,
                                                         const std::string &entry) const
  {
    const auto found =
        std::find_if(options.begin(), options.end(),
                     [&](const ParameterText::Entry &e) { return e.section == section && e.name == entry; });
    return found == options.end() ? nullptr : &*found;
  }

  std::string ParameterFile::raw_value(const std::string &section, const std::string &entry,
                                       const std::string &default_value) const
  {
    if (const auto *option = find_option(section, entry))
      return option->value;
    const auto *given = text.find(section, entry);
    return given ? given->value : default_value;
  }

  std::vector<std::string> ParameterFile::list(const std::string &entry) const
  {
    return split_list(raw_value("", entry));
  }

  std::vector<std::string> ParameterFile::top_sections() const
  {
    std::vector<std::string> names;
    for (const auto &section : text.sections)
      if (section.path.find('/') == std::string::npos)
        names.push_back(section.path);
    return names;
  }

  std::string ParameterFile::location(const ParameterText::Entry &entry) const
  {
    return entry.line > 0 ? text.file_name + ":" + std::to_string(entry.line)
                          : "--set \"" + joined_path(entry.section, entry.name) + "\"";
  }

  DeclaredParameters ParameterFile::parse(dealii::ParameterHandler &prm) const
  {
    DeclaredParameters declared = declared_parameters(prm);
    for (const auto &section : text.sections)
      check_section(declared, section.path, text.file_name + ":" + std::to_string(section.line) + ": ");

    std::vector<ParameterText::Entry> all = text.entries;
    all.insert(all.end(), options.begin(), options.end());
    for (const auto &entry : all)
      check_name(declared, entry, location(entry) + ": ");

    for (const auto &entry : all)
    {
      DeclaredParameters::Entry &known = *declared.find(entry.section, entry.name);
      const std::string unit = unit_of(known.documentation);
      const std::string subject =
          location(entry) + ": entry \"" + entry.name + "\" of " + section_text(entry.section) + " ";
      const bool is_number = known.pattern.find("[Double") != std::string::npos ||
                             known.pattern.find("[Integer") != std::string::npos;
      if (is_number && !not_finite_word(entry.value).empty())
        throw InputError(subject + "holds \"" + not_finite_word(entry.value) +
                         "\", which is not a finite number; give " + pattern_in_words(known.pattern) +
                         (unit.empty() ? "" : " in " + unit));
      // Names of input files count from the folder of the parameter file.
      ParameterText::Entry resolved = entry;
      if (known.pattern.find("[FileName") != std::string::npos && !entry.value.empty())
        resolved.value = resolved_path(entry.value);
      if (!set_value(prm, resolved))
        throw InputError(subject + "is \"" + entry.value + "\" but has to be " +
                         pattern_in_words(known.pattern) +
                         (unit.empty() || !is_number ? "" : ", in " + unit) + " (default " +
                         (known.default_value.empty() ? "empty" : known.default_value) + ")");
      known.value = resolved.value;
    }
    return declared;
  }

  std::string ParameterFile::where(const std::string &section, const std::string &entry) const
  {
    const std::string names =
        (section.empty() ? "" : section_text(section) + ", ") + "entry \"" + entry + "\"";
    if (find_option(section, entry))
      return "--set \"" + joined_path(section, entry) + "\"";
    if (const auto *given = text.find(section, entry))
      return text.file_name + ":" + std::to_string(given->line) + ", " + names;
    return text.file_name.empty() ? names : text.file_name + ", " + names + " (not set, default)";
  }

  std::string ParameterFile::where_section(const std::string &path) const
  {
    for (const auto &section : text.sections)
      if (section.path == path)
        return text.file_name + ":" + std::to_string(section.line) + ", " + section_text(path);
    return text.file_name.empty() ? section_text(path) : text.file_name + ", " + section_text(path);
  }

  std::string ParameterFile::located(const std::string &message) const
  {
    if (text.file_name.empty() || message.find(text.file_name) != std::string::npos ||
        message.compare(0, 5, "--set") == 0)
      return message;
    const auto named = [&](const std::string &path) { return message.find(path) != std::string::npos; };
    // Every option that the message names ...
    std::string where;
    for (const auto &option : options)
      if (named(joined_path(option.section, option.name)))
        where += (where.empty() ? "" : " and ") + location(option);
    // ... and of the file the entry, or else the section: the longest path wins.
    std::string found, in_file;
    const auto consider = [&](const std::string &path, const unsigned int line)
    {
      if (path.size() > found.size() && named(path))
      {
        found = path;
        in_file = text.file_name + ":" + std::to_string(line);
      }
    };
    for (const auto &entry : text.entries)
      if (!find_option(entry.section, entry.name))
        consider(joined_path(entry.section, entry.name), entry.line);
    if (where.empty())
      for (const auto &section : text.sections)
        consider(section.path, section.line);
    if (where.empty() && found.empty())
      in_file = text.file_name;
    // the entry is not named twice
    for (const std::string begin : {"", "Entry "})
      for (const auto &option : options)
        if (const std::string path = joined_path(option.section, option.name);
            in_file.empty() && where == location(option) && message.rfind(begin + path, 0) == 0)
          return where + message.substr((begin + path).size());
    if (!where.empty() && !in_file.empty())
      where += " and ";
    return where + in_file + ": " + message;
  }

  std::string ParameterFile::prefer_option(const std::string &path_1, const std::string &path_2)
  {
    for (const auto &[kept, dropped] : {std::make_pair(path_1, path_2), std::make_pair(path_2, path_1)})
    {
      const auto [kept_section, kept_name] = split_path(kept);
      const auto [section, name] = split_path(dropped);
      const auto *option = find_option(kept_section, kept_name);
      const auto *in_file = text.find(section, name);
      if (option && !option->value.empty() && in_file && !in_file->value.empty() &&
          !find_option(section, name))
      {
        text.entries.erase(text.entries.begin() + (in_file - text.entries.data()));
        return dropped;
      }
    }
    return "";
  }

  std::string ParameterFile::resolved_path(const std::string &name) const
  {
    namespace fs = std::filesystem;
    if (fs::path(name).is_absolute() || text.file_name.empty())
      return name;
    // whoever reads the file says what is wrong with it
    std::error_code ignored;
    const fs::path beside = fs::absolute(fs::path(text.file_name), ignored).parent_path() / name;
    return fs::exists(beside, ignored) || !fs::exists(name, ignored) ? beside.lexically_normal().string()
                                                                     : name;
  }

  std::string read_file_on_all_ranks(const std::string &file_name, const std::string &what)
  {
    std::pair<std::string, std::string> bytes_and_error;
    if (dealii::Utilities::MPI::this_mpi_process(run_communicator()) == 0)
    {
      std::ifstream file(file_name, std::ios::binary);
      std::ostringstream content;
      std::error_code ignored;
      if (std::filesystem::is_directory(file_name, ignored))
        bytes_and_error.second = "is a folder";
      else if (!file)
        bytes_and_error.second =
            std::filesystem::exists(file_name, ignored) ? "cannot be read" : "does not exist";
      else
        content << file.rdbuf();
      bytes_and_error.first = content.str();
    }
    bytes_and_error = dealii::Utilities::MPI::broadcast(run_communicator(), bytes_and_error);
    if (!bytes_and_error.second.empty())
      throw InputError("the " + what + " \"" + file_name + "\" " + bytes_and_error.second +
                       "; give the name of an existing one");
    return bytes_and_error.first;
  }
} // namespace vibrocontact
