#pragma once

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  struct RollingCase;

  /// `subsection Branch` of it: each cycle is followed over an entry.
  struct CycleBranchParameters
  {
    /// "none": no cycle is followed
    std::string entry = "none";
    /// from one value to the other, in the unit of the entry
    std::vector<double> range;
    unsigned int most_points = 200;
    /// between neighbours: root of the sum of squares of the changes of the state, the period, and the value over the range
    double largest_step = 0.1;

    bool any() const { return entry != "none"; }
    double from() const { return range.front(); }
    double to() const { return range.back(); }
    /// what the entry is in every section Contact, no part of a case
    bool is_friction() const { return entry == "Contact/Friction coefficient"; }
    /// The value of the entry in a case; @pre any()
    double &value_in(RollingCase &constants) const;
    void declare_parameters(dealii::ParameterHandler &prm);
    /// @param constants what section Rolling and the friction say @throws InputError for what cannot be followed
    void check(RollingCase constants) const;
  };
} // namespace vibrocontact
