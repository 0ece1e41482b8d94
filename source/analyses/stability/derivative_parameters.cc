#include <vibrocontact/analyses/stability/derivative_parameters.h>
#include <vibrocontact/base/exceptions.h>

#include <algorithm>

namespace vibrocontact
{
  void DerivativeParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.enter_subsection("Derivatives");
    prm.add_parameter(
        "Entries", entries,
        "Entries with a number, by their paths such as Contact/Friction coefficient, separated by "
        "commas: derivatives of frequency and growth of the roots with respect to each. "
        "Units: none.",
        List(Anything(), 0, 100));
    prm.add_parameter(
        "Standard deviations", deviations,
        "Of each of the entries, if they scatter (normal, independent of each other); empty: they "
        "do not. Units: those of the entries.",
        List(Double(0), 0, 100));
    prm.add_parameter("Draws", n_draws,
                      "Cases drawn at random to show the scatter of the roots beside that of first order; "
                      "5000 at most, as the file is read again for each before anything runs (20 ms). "
                      "Units: none.",
                      Integer(0, 5000));
    prm.add_parameter("Seed", seed, "Of the draws. Units: none.", Integer(0));
    prm.leave_subsection();
  }

  void DerivativeParameters::check() const
  {
    const std::string section = "Stability/Derivatives/";
    for (auto entry = entries.begin(); entry != entries.end(); ++entry)
      if (std::count(entries.begin(), entry, *entry) > 0)
        throw InputError(section + "Entries lists " + *entry + " twice: leave one of them.");
    if (!deviations.empty() && deviations.size() != entries.size())
      throw InputError(section + "Standard deviations has " + std::to_string(deviations.size()) +
                       " values for " + std::to_string(entries.size()) + " Entries: give one for each.");
    if (n_draws > 0 && deviations.empty())
      throw InputError(section + "Draws asks for " + std::to_string(n_draws) +
                       " cases at random, but there are no Standard deviations: give them.");
  }
} // namespace vibrocontact
