#pragma once

#include <vibrocontact/contact/laws/normal_law.h>

namespace vibrocontact
{
  /// All normal laws. Whoever adds one adds its file to this folder and its row to normal_laws.cc.
  const std::vector<NormalLawEntry> &normal_laws();

  /// @throws InputError naming the known laws
  const NormalLawEntry &find_normal_law(const std::string &name);

  /// @param numbers of the law's parameters, as in LawDescription
  /// @throws InputError naming the known laws, or for numbers that make none
  std::shared_ptr<const NormalLaw> create_normal_law(const std::string &name,
                                                     const std::vector<double> &numbers = {});
} // namespace vibrocontact
