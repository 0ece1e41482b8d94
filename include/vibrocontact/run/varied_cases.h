#pragma once

#include <vibrocontact/run/sweep_cases.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// What an analysis varies about the case of the file.
  struct Variations
  {
    /// whose they are; the section that asks for them, whose entry `Entries` lists the following
    std::string analysis, section;
    /// Section/Entry
    std::vector<std::string> entries;
    /// standard deviations, in their units
    std::vector<double> deviations;
    unsigned int n_draws, seed;
  };

  /// The cases about that of the file by which an analysis finds derivatives to m entries, and scatter:
  ///
  ///     0           the file's
  ///     1 ... 2 m   entry 1 a step more, a step less, entry 2 a step more, ...
  ///     2 m + 1 ... draws, all entries at random
  ///
  /// Their values are those of all entries. A step is 1e-4 of the value, 5 um of the lateral position, 0.5 um of a length that is zero.
  /// @throws InputError for an entry that is no number, counts or measures what discretises, or is zero and no length, or a drawn
  /// value that its entry does not take
  SweepCases varied_cases(const Variations &asked, const Parameters &parameters, const ParameterFile &file,
                          const std::vector<std::string> &overrides);
} // namespace vibrocontact
