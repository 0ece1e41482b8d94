#pragma once

#include <vibrocontact/base/entries_read.h>
#include <vibrocontact/run/parameters.h>

namespace vibrocontact
{
  /// Entries of the section of body @p number.
  void add_body(EntriesRead &entries, const Parameters &parameters, unsigned int number, const BodyUse &use);

  /// All entries of a section that a program adds: what it does with them is its own affair.
  void add_all_entries(EntriesRead &entries, const std::string &section, ParameterGroup &group);

  /// How many poles are fitted by what iterations, of section Identification. @param condition in words
  void add_pole_numbers(EntriesRead &entries, const IdentificationParameters &identification, bool is_read,
                        const std::string &condition);
} // namespace vibrocontact
