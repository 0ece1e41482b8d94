#pragma once

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// What a ParameterHandler has declared, as plain data: deal.II offers no way to walk through its entries,
  /// so they are read from its JSON output. Order of declaration.
  struct DeclaredParameters
  {
    struct Entry
    {
      /// path of the section, name, value now, default
      std::string section, name, value, default_value;
      /// meaning with units; deal.II's description of the pattern
      std::string documentation, pattern;
    };
    std::vector<Entry> entries;
    /// paths of all sections, the empty one (top level) first
    std::vector<std::string> sections;

    const Entry *find(const std::string &section, const std::string &name) const;
    Entry *find(const std::string &section, const std::string &name);
    bool has_section(const std::string &path) const;
    /// All but the entries of these paths.
    DeclaredParameters without(const std::vector<std::string> &paths) const;
    /// Names of the entries in a section, or of the sections one level below it.
    std::vector<std::string> entry_names(const std::string &section) const;
    std::vector<std::string> subsection_names(const std::string &section) const;
  };

  DeclaredParameters declared_parameters(const dealii::ParameterHandler &prm);

  /// A deal.II pattern in words: "[Double 0...MAX_DOUBLE (inclusive)]" -> "a number of at least 0".
  std::string pattern_in_words(const std::string &pattern);

  /// The text after "Units:" in an entry's documentation without its full stop; empty if none or "none".
  std::string unit_of(const std::string &documentation);

  /// How to print: every parameter with meaning, unit, pattern and default as comments, or the values alone.
  enum class ParameterStyle
  {
    documented,
    values_only
  };

  /// The parameters as a valid parameter file. Sections that have no entries are left out.
  std::string print_parameters(const DeclaredParameters &parameters, ParameterStyle style);
} // namespace vibrocontact
