#pragma once

#include <vibrocontact/run/entry_list.h>
#include <vibrocontact/run/parameters.h>

namespace vibrocontact
{
  /// What an analysis needs of a body, which decides what entries of its section matter.
  struct BodyUse
  {
    /// points of its surface are in contact, its mesh is refined under them
    bool contact = false;
    /// places on it are excited and looked at
    bool points = false;
    /// forces that stand on it: gravity, tractions
    bool loads = false;
    /// it moves by its mass, in kept modes
    bool motion = false;
    /// it loses energy; by modal damping as section Modes scales it
    bool loss = false, scaled_damping = false;
    /// its contact points move along the road
    bool tangential = false;
  };

  /// Entries of the section of body @p number.
  void add_body(EntriesRead &entries, const Parameters &parameters, unsigned int number, const BodyUse &use);

  /// All entries of a section that a program adds: what it does with them is its own affair.
  void add_all_entries(EntriesRead &entries, const std::string &section, ParameterGroup &group);

  /// How many poles are fitted by what iterations, of section Identification. @param condition in words
  void add_pole_numbers(EntriesRead &entries, const IdentificationParameters &identification, bool is_read,
                        const std::string &condition);
} // namespace vibrocontact
