#include <vibrocontact/analyses/periodic/branch.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/parameter_text.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace vibrocontact
{
  void BranchParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter("Parameter", parameter,
                      "What the motion is followed in; none: no continuation. Units: none.",
                      Selection("none|frequency|force|gap"));
    prm.add_parameter("First value", first,
                      "The branch begins there, and ends there if it comes back. Units: Hz, N or m.",
                      Double());
    prm.add_parameter("Last value", last, "The branch ends there. Units: Hz, N or m.", Double());
    prm.add_parameter(
        "Start value", start,
        "Begin inside of the range, from which the branch goes both ways; empty: the first value. "
        "Units: Hz, N or m.",
        Anything());
    prm.add_parameter(
        "Scale", scale,
        "Change of the parameter that counts as much as closing the gap by force; 0: a tenth of the "
        "range. Units: Hz, N or m.",
        Double(0));
    prm.add_parameter("Largest step", largest_step, "Arc length over the scales. Units: none.", Double(1e-9));
    prm.add_parameter("Smallest step", smallest_step, "Shorter steps end the branch. Units: none.",
                      Double(1e-14));
    prm.add_parameter("Most points", max_points, "More points end the branch. Units: none.",
                      Integer(2, 10000000));
    prm.add_parameter("Location tolerance", tolerance, "Of folds and grazing. Units: Hz, N or m.",
                      Double(1e-14));
    prm.add_parameter(
        "Stability", stability,
        "Floquet multipliers: by the monodromy matrix, or by Hill's method that starts from it. Units: none.",
        Selection("none|monodromy|hill"));
    prm.add_parameter(
        "Mode limit", mode_limit,
        "Modes of the monodromy matrix: up to so many times the frequency, the others are static. "
        "Units: none.",
        Double(1));
    prm.add_parameter("Hill harmonics", hill_harmonics, "Harmonics of Hill's method. Units: none.",
                      Integer(1, 1000));
    prm.add_parameter("Pairs", pairs,
                      "Curves beside the first one: pairs of bases \"trial:weighting, ...\". Units: none.",
                      Anything());
    prm.add_parameter(
        "Numbers", numbers,
        "Numbers of functions of these curves; empty: Periodic/Number of functions. Units: none.",
        List(Integer(1, 100000), 0, 1000));
  }

  void BranchParameters::check() const
  {
    if (!is_wanted())
      return;
    if (first == last)
      throw InputError("Periodic/Continuation: First value and Last value are equal: give the range of the " +
                       parameter + ".");
    if (parameter == "frequency" && std::min(first, last) <= 0)
      throw InputError(
          "Periodic/Continuation: frequencies must be positive: change First value or Last value.");
    if (parameter == "force" && std::min(first, last) < 0)
      throw InputError("Periodic/Continuation: amplitudes of the force must not be negative: change First "
                       "value or Last value.");
    if (parsed_pairs().empty() && !numbers.empty())
      throw InputError(
          "Periodic/Continuation/Numbers is given without Periodic/Continuation/Pairs: give the pairs, or "
          "Periodic/Number of functions for the first curve.");
    settings();
  }

  std::vector<std::pair<std::string, std::string>> basis_pairs(const std::string &text,
                                                               const std::string &entry)
  {
    std::vector<std::pair<std::string, std::string>> result;
    for (const std::string &member : split_list(text))
    {
      const std::size_t colon = member.find(':');
      if (colon == std::string::npos)
        throw InputError(entry + ": \"" + member + "\" is no pair; write it as trial:weighting.");
      result.emplace_back(trimmed(member.substr(0, colon)), trimmed(member.substr(colon + 1)));
    }
    return result;
  }

  std::vector<std::pair<std::string, std::string>> BranchParameters::parsed_pairs() const
  {
    return basis_pairs(pairs, "Periodic/Continuation/Pairs");
  }

  std::vector<BranchSettings> BranchParameters::settings() const
  {
    BranchSettings result;
    result.parameter = parameter == "force" ? SceneParameter::force
                       : parameter == "gap" ? SceneParameter::gap
                                            : SceneParameter::frequency;
    result.least = std::min(first, last);
    result.most = std::max(first, last);
    result.start = first;
    result.direction = last > first ? 1 : -1;
    result.scale = scale;
    result.max_step = largest_step;
    result.first_step = std::min(result.first_step, largest_step);
    result.min_step = smallest_step;
    result.max_points = max_points;
    result.location_tolerance = tolerance;
    result.stability = stability == "none"   ? StabilityMethod::none
                       : stability == "hill" ? StabilityMethod::hill
                                             : StabilityMethod::monodromy;
    result.mode_limit = mode_limit;
    result.hill_harmonics = hill_harmonics;
    if (trimmed(start).empty())
      return {result};
    std::istringstream stream(start);
    if (!(stream >> result.start) || result.start < result.least || result.start > result.most)
      throw InputError("Periodic/Continuation/Start value: \"" + start +
                       "\" is no number between First value and Last value.");
    BranchSettings back = result;
    back.direction = -result.direction;
    return {back, result};
  }
} // namespace vibrocontact
