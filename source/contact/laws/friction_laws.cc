#include <vibrocontact/base/named_table.h>
#include <vibrocontact/contact/laws/coulomb.h>
#include <vibrocontact/contact/laws/falling_friction.h>
#include <vibrocontact/contact/laws/friction_curve.h>
#include <vibrocontact/contact/laws/friction_laws.h>

namespace vibrocontact
{
  const std::vector<FrictionLawEntry> &friction_laws()
  {
    static const std::vector<FrictionLawEntry> table = {coulomb(), falling_friction(), friction_curve()};
    return table;
  }

  const FrictionLawEntry &find_friction_law(const std::string &name,
                                            const std::vector<FrictionLawEntry> &table)
  {
    return find_named(table, name, "friction law");
  }

  std::shared_ptr<const FrictionLaw> create_friction_law(const std::string &name,
                                                         const std::vector<double> &numbers,
                                                         const std::vector<FrictionLawEntry> &table)
  {
    const FrictionLawEntry &entry = find_friction_law(name, table);
    check_numbers(name, entry.parameters, numbers.size());
    return entry.make(numbers);
  }
} // namespace vibrocontact
