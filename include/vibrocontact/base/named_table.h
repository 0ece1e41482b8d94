#pragma once

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/nearest_names.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// Names of the rows of a family's table, whose rows have a member `name`.
  template <typename Row>
  std::vector<std::string> names_of(const std::vector<Row> &table)
  {
    std::vector<std::string> names;
    for (const Row &row : table)
      names.push_back(row.name);
    return names;
  }

  /// "a|b|c", the pattern of an entry that names a row.
  inline std::string selection(const std::vector<std::string> &names)
  {
    std::string text;
    for (const std::string &name : names)
      text += (text.empty() ? "" : "|") + name;
    return text;
  }

  /// The row of a name. @param what the family's members are, for the message
  /// @throws InputError naming what may have been meant
  template <typename Row>
  const Row &find_named(const std::vector<Row> &table, const std::string &name, const std::string &what)
  {
    for (const Row &row : table)
      if (row.name == name)
        return row;
    throw InputError("There is no " + what + " called \"" + name + "\"; " +
                     name_suggestion(name, names_of(table)));
  }
} // namespace vibrocontact
