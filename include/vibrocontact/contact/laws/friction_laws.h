#pragma once

#include <vibrocontact/contact/laws/friction_law.h>

namespace vibrocontact
{
  /// All friction laws. Whoever adds one adds its file to this folder and its row to friction_laws.cc.
  const std::vector<FrictionLawEntry> &friction_laws();

  /// @throws InputError naming the known laws
  const FrictionLawEntry &find_friction_law(const std::string &name);

  /// @param numbers of the law's parameters, as in LawDescription
  /// @throws InputError naming the known laws, or for numbers that make none
  std::shared_ptr<const FrictionLaw> create_friction_law(const std::string &name,
                                                         const std::vector<double> &numbers);
} // namespace vibrocontact
