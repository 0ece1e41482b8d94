#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vibrocontact
{
  /// A parameter file as written, before anything is known about what is valid in it.
  ///
  ///     set Bodies = wheel, rail        # a comment
  ///     subsection Contact
  ///       set Friction coefficient = 0.3
  ///     end
  ///
  /// A line that ends in a backslash continues on the next; a byte-order mark of UTF-8 is skipped. Sections
  /// are named by their path: wheel/Material; the top level has the empty path.
  struct ParameterText
  {
    struct Entry
    {
      std::string section, name, value;
      unsigned int line = 0;
    };
    struct Section
    {
      std::string path;
      unsigned int line = 0;
    };

    /// as given on the command line; used in messages
    std::string file_name;
    /// bytes of the file
    std::string bytes;
    std::vector<Entry> entries;
    /// in the order of the file, each once, at its first line
    std::vector<Section> sections;

    const Entry *find(const std::string &section, const std::string &name) const;
    bool has_section(const std::string &path) const;
  };

  /// Splits the text into sections and entries.
  /// @throws InputError with the line on a line that cannot be read, unbalanced subsection/end, an entry set
  /// twice
  ParameterText scan_parameter_text(const std::string &file_name, const std::string &bytes);

  /// "Contact" -> `section Contact`, "" -> `the top level`.
  std::string section_text(const std::string &path);
  /// wheel/Material + Density -> wheel/Material/Density
  std::string joined_path(const std::string &section, const std::string &name);
  /// Text without blanks at its ends.
  std::string trimmed(const std::string &text);
  /// ASCII letters become small ones.
  std::string lower_case(std::string_view text);
  /// "a, b" -> {a, b}, without empty members.
  std::vector<std::string> split_list(const std::string &text);
  /// A word that is a finite number as a whole; nothing: it is none.
  std::optional<double> finite_number(const std::string &word);
} // namespace vibrocontact
