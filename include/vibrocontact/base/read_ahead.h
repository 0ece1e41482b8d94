#pragma once

#include <vibrocontact/base/parameter_file.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  // What decides what else is declared is read before the declaration.

  /// The value of an entry: that of the file, if it is one of the choices, or else the default. A wrong one is refused with its
  /// line when everything is read.
  std::string read_ahead_choice(const ParameterFile &file, const std::string &section,
                                const std::string &entry, const std::string &by_default,
                                const dealii::Patterns::Selection &choices);

  /// Names in an entry that lists subsections, separated by commas.
  struct ListedNames
  {
    /// as the run has them, and those of the file alone: an option that lists others leaves the file its sections
    std::vector<std::string> listed, unlisted;
  };
  /// @throws InputError for a name that is there twice or that no section may have
  ListedNames read_ahead_names(const ParameterFile &file, const std::string &section,
                               const std::string &entry);

  /// Groups of parameters with these names.
  template <typename Group>
  std::vector<Group> groups_of(const std::vector<std::string> &names)
  {
    std::vector<Group> groups;
    for (const std::string &name : names)
      groups.emplace_back().name = name;
    return groups;
  }

  /// The names as the entry has them.
  template <typename Group>
  std::string names_of_groups(const std::vector<Group> &groups)
  {
    std::string names;
    for (const Group &group : groups)
      names += (names.empty() ? "" : ", ") + group.name;
    return names;
  }

  /// A subsection of each name, listed or not, in a section.
  template <typename Group>
  void declare_groups(dealii::ParameterHandler &prm, const std::string &section, std::vector<Group> &listed,
                      std::vector<Group> &unlisted)
  {
    prm.enter_subsection(section);
    for (std::vector<Group> *const some : {&listed, &unlisted})
      for (Group &group : *some)
      {
        prm.enter_subsection(group.name);
        group.declare_parameters(prm);
        prm.leave_subsection();
      }
    prm.leave_subsection();
  }
} // namespace vibrocontact
