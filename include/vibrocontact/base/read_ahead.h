#pragma once

#include <vibrocontact/base/parameter_file.h>

#include <deal.II/base/patterns.h>

#include <string>

namespace vibrocontact
{
  /// The value of an entry that decides what else is declared, read before the declaration: that of the file, if it is one of the
  /// choices, or else the default. A wrong one is refused with its line when everything is read.
  inline std::string read_ahead_choice(const ParameterFile &file, const std::string &section,
                                       const std::string &entry, const std::string &by_default,
                                       const dealii::Patterns::Selection &choices)
  {
    const std::string value = file.raw_value(section, entry, by_default);
    return choices.match(value) ? value : by_default;
  }
} // namespace vibrocontact
