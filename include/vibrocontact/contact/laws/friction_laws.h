#pragma once

#include <vibrocontact/contact/laws/friction_law.h>

namespace vibrocontact
{
  /// The shipped friction laws; a program may have more (run/tables.h).
  const std::vector<FrictionLawEntry> &friction_laws();

  /// @throws InputError naming the known laws
  const FrictionLawEntry &find_friction_law(const std::string &name,
                                            const std::vector<FrictionLawEntry> &table);

  /// @param numbers of the law's parameters, as in LawDescription
  /// @throws InputError naming the known laws, or for numbers that make none
  std::shared_ptr<const FrictionLaw>
  create_friction_law(const std::string &name, const std::vector<double> &numbers,
                      const std::vector<FrictionLawEntry> &table = friction_laws());
} // namespace vibrocontact
