#include <vibrocontact/base/named_table.h>
#include <vibrocontact/contact/laws/exponential_penalty.h>
#include <vibrocontact/contact/laws/linear_spring.h>
#include <vibrocontact/contact/laws/normal_laws.h>
#include <vibrocontact/contact/laws/signorini.h>
#include <vibrocontact/contact/laws/spring_curve.h>

namespace vibrocontact
{
  const std::vector<NormalLawEntry> &normal_laws()
  {
    static const std::vector<NormalLawEntry> table = {signorini(), exponential_penalty(), linear_spring(),
                                                      spring_curve()};
    return table;
  }

  const NormalLawEntry &find_normal_law(const std::string &name, const std::vector<NormalLawEntry> &table)
  {
    return find_named(table, name, "normal contact law");
  }

  std::shared_ptr<const NormalLaw> create_normal_law(const std::string &name,
                                                     const std::vector<double> &numbers,
                                                     const std::vector<NormalLawEntry> &table)
  {
    const NormalLawEntry &entry = find_normal_law(name, table);
    check_numbers(name, entry.parameters, numbers.size());
    return entry.make(numbers);
  }
} // namespace vibrocontact
