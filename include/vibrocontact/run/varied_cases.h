#pragma once

#include <vibrocontact/run/sweep_cases.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// Section of what varied_cases() makes.
  constexpr const char *section_of_variations = "Stability/Derivatives";

  /// The cases about that of the file by which Stability/Derivatives finds derivatives, m of its entries, and scatter:
  ///
  ///     0           the file's
  ///     1 ... 2 m   entry 1 a step more, a step less, entry 2 a step more, ...
  ///     2 m + 1 ... draws, all entries at random
  ///
  /// Their values are those of all entries. A step is 1e-4 of the value; of the lateral position, which may be zero, 5 um.
  /// @throws InputError for an entry that is no number or zero, or a drawn value that its entry does not take
  SweepCases varied_cases(const Parameters &parameters, const ParameterFile &file,
                          const std::vector<std::string> &overrides);
} // namespace vibrocontact
