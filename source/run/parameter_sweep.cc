#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/base/parameter_text.h>
#include <vibrocontact/run/parameter_sweep.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace vibrocontact
{
  namespace
  {
    constexpr unsigned int most_cases = 20000;
    /// that rounding may leave between the last step and the end of a range
    constexpr double part_of_step = 1e-6;

    double steps_of(const std::vector<double> &range)
    {
      return (range[1] - range[0]) / range[2];
    }

    long whole_steps(const std::vector<double> &range)
    {
      return std::lround(std::floor(steps_of(range) + part_of_step));
    }

    /// @param name of the entry with the list
    void check_list(const ParameterSweep::Axis &axis, const std::string &name)
    {
      const std::vector<std::string> values = axis.values();
      const std::size_t places = 1 + std::count(axis.list.begin(), axis.list.end(), ',');
      if (values.size() != places)
        throw InputError(name + " is '" + axis.list + "', with an empty place: take out a comma or fill it.");
      for (auto value = values.begin(); value != values.end(); ++value)
        for (auto before = values.begin(); before != value; ++before)
        {
          char *end = nullptr, *end_before = nullptr;
          const bool equal_numbers =
              std::strtod(value->c_str(), &end) == std::strtod(before->c_str(), &end_before) && *end == 0 &&
              *end_before == 0;
          if (*value == *before || equal_numbers)
            throw InputError(name + " lists " + *value + " twice: leave one of them.");
        }
    }
  } // namespace

  std::vector<std::string> ParameterSweep::Axis::values() const
  {
    if (range.size() != 3)
      return split_list(list);
    std::vector<std::string> result;
    const long n = whole_steps(range);
    for (long k = 0; k <= n; ++k)
    {
      // a zero of the range is exactly zero
      const double value = range[0] + k * range[2];
      char text[32];
      std::snprintf(text, sizeof text, "%.12g", std::abs(value) < 1e-9 * std::abs(range[2]) ? 0. : value);
      result.push_back(text);
    }
    return result;
  }

  void ParameterSweep::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.enter_subsection("Sweep");
    const auto declare = [&](Axis &axis, const std::string &prefix, const std::string &role)
    {
      const auto name = [&](const std::string &text) {
        return prefix.empty() ? text : prefix + " " + std::string(1, std::tolower(text[0])) + text.substr(1);
      };
      prm.add_parameter(name("Entry"), axis.entry,
                        role +
                            ", by its path such as Contact/Friction coefficient, Contact/Lateral position, "
                            "Rolling/Lateral creepage, rail/Rail/Contact at; several, separated by commas, "
                            "take the same values; empty: none. Units: none.",
                        Anything());
      prm.add_parameter(name("Values"), axis.list,
                        "Its values, separated by commas. Units: those of the entry.", Anything());
      prm.add_parameter(name("Range"), axis.range,
                        "Instead of a list: first value, last value, step. Units: those of the entry.",
                        List(Double(), 0, 3));
    };
    declare(first, "", "Entry that is swept");
    declare(second, "Second", "Entry that runs through its values for each value of the first");
    prm.leave_subsection();
  }

  void ParameterSweep::check(const std::string &section) const
  {
    const std::string path = section + "/Sweep/";
    if (first.entry.empty() && !second.entry.empty())
      throw InputError(path + "Second entry is given without a first: name it in " + path + "Entry.");
    std::vector<std::string> all;
    const auto check_axis = [&](const Axis &axis, const std::string &prefix)
    {
      const std::string values = path + (prefix.empty() ? "Values" : prefix + "values"),
                        range = path + (prefix.empty() ? "Range" : prefix + "range"),
                        entry = path + (prefix.empty() ? "Entry" : prefix + "entry");
      if (axis.entry.empty())
      {
        if (!axis.list.empty() || !axis.range.empty())
          throw InputError(values + " or range is given, but no entry: name it in " + entry + ".");
        return;
      }
      const std::vector<std::string> moved = moved_entries({axis.entry});
      if (moved.size() != 1 + std::size_t(std::count(axis.entry.begin(), axis.entry.end(), ',')))
        throw InputError(entry + " is '" + axis.entry +
                         "', with an empty place: take out a comma or fill it.");
      for (const std::string &one : moved)
      {
        if (one.rfind("Output/", 0) == 0 || one.find("/Sweep/") != std::string::npos)
          throw InputError(entry + " names " + one +
                           ", which changes nothing that a case computes: sweep an entry of the bodies, of "
                           "their contact or of the analysis.");
        if (one.find('/') == std::string::npos)
          throw InputError(entry + " names " + one +
                           ", which is no entry of a section: write it as "
                           "Section/Entry.");
        if (one == lateral_position && moved.size() > 1)
          throw InputError(entry + " moves " + one +
                           " with others, but it is taken from a band of contact points: sweep it alone.");
        if (std::count(all.begin(), all.end(), one) > 0)
          throw InputError(entry + " names " + one + ", which the sweep moves already: name it once.");
        all.push_back(one);
      }
      if (axis.list.empty() == axis.range.empty())
        throw InputError(entry + " is " + axis.entry + ": give either " + values + " or " + range + ".");
      if (axis.range.empty())
      {
        check_list(axis, values);
        return;
      }
      if (axis.range.size() != 3 || axis.range[2] == 0 || steps_of(axis.range) < 0)
        throw InputError(range +
                         " is not first, last, step with a step from the first towards the last value: "
                         "write for instance -0.01, 0.03, 0.001.");
      if (steps_of(axis.range) > most_cases)
        throw InputError(range + " makes more than 20,000 cases: take larger steps.");
      const long whole = whole_steps(axis.range);
      if (steps_of(axis.range) - whole > part_of_step)
        throw InputError(range + " has no step that ends at its last value " + number_text(axis.range[1]) +
                         ", only at " + number_text(axis.range[0] + whole * axis.range[2]) + " and " +
                         number_text(axis.range[0] + (whole + 1) * axis.range[2]) +
                         ": write one of them, or another step.");
    };
    check_axis(first, "");
    check_axis(second, "Second ");
    const std::size_t n = first.values().size() * std::max<std::size_t>(1, second.values().size());
    if (n > most_cases)
      throw InputError(path + "Values and Second values make " + std::to_string(n) +
                       " cases, more than 20,000: take larger steps.");
  }

  std::vector<std::string> moved_entries(const std::vector<std::string> &axes)
  {
    std::vector<std::string> entries;
    for (const std::string &axis : axes)
      for (const std::string &entry : split_list(axis))
        entries.push_back(entry);
    return entries;
  }
} // namespace vibrocontact
