#pragma once

#include <vibrocontact/contact/laws/normal_law.h>

namespace vibrocontact
{
  /// The shipped normal laws; a program may have more (run/tables.h).
  const std::vector<NormalLawEntry> &normal_laws();

  /// @throws InputError naming the known laws
  const NormalLawEntry &find_normal_law(const std::string &name, const std::vector<NormalLawEntry> &table);

  /// @param numbers of the law's parameters, as in LawDescription
  /// @throws InputError naming the known laws, or for numbers that make none
  std::shared_ptr<const NormalLaw>
  create_normal_law(const std::string &name, const std::vector<double> &numbers = {},
                    const std::vector<NormalLawEntry> &table = normal_laws());
} // namespace vibrocontact
