#pragma once

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// `subsection Sweep` of an analysis: one or two entries of the file and their values. The second entry
  /// runs through all of its values for each value of the first.
  struct ParameterSweep
  {
    /// One swept entry: its path, e.g. Contact/Friction coefficient, and its values, listed or as first,
    /// last, step; an empty path: nothing is swept. Several paths, separated by commas, take the same values.
    struct Axis
    {
      std::string entry;
      std::string list;
      std::vector<double> range;

      /// The values as they would stand in a file; numbers of a range with 12 digits.
      std::vector<std::string> values() const;
    };
    Axis first, second;

    static constexpr const char *lateral_position = "Contact/Lateral position";
    static constexpr const char *names = "Entry, Values, Range, Second entry, Second values, Second range";

    bool any() const { return !first.entry.empty(); }
    bool sweeps(const std::string &entry) const { return first.entry == entry || second.entry == entry; }

    /// Inside the section of the analysis.
    void declare_parameters(dealii::ParameterHandler &prm);
    /// @throws InputError naming `section`
    void check(const std::string &section) const;
  };

  /// Paths of all entries that axes move, of which each may name several.
  std::vector<std::string> moved_entries(const std::vector<std::string> &axes);
} // namespace vibrocontact
