#pragma once

#include <vibrocontact/contact/laws/normal_law.h>

#include <functional>

namespace vibrocontact
{
  /// One row of the table of normal laws.
  struct NormalLawEntry
  {
    /// in the parameter file, and a sentence
    std::string name, help;
    std::vector<LawParameter> parameters;
    /// from the numbers of the parameters; @throws InputError
    std::function<std::shared_ptr<const NormalLaw>(const std::vector<double> &)> make;
  };

  /// All normal laws. Whoever adds one adds its file to this folder and its row to normal_laws.cc.
  const std::vector<NormalLawEntry> &normal_laws();

  /// @throws InputError naming the known laws
  const NormalLawEntry &find_normal_law(const std::string &name);

  /// @param numbers of the law's parameters, as in LawDescription
  /// @throws InputError naming the known laws, or for numbers that make none
  std::shared_ptr<const NormalLaw> create_normal_law(const std::string &name,
                                                     const std::vector<double> &numbers = {});
} // namespace vibrocontact
