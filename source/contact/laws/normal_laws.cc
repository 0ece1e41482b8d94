#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/nearest_names.h>
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

  const NormalLawEntry &find_normal_law(const std::string &name)
  {
    std::vector<std::string> names;
    for (const NormalLawEntry &entry : normal_laws())
    {
      if (entry.name == name)
        return entry;
      names.push_back(entry.name);
    }
    throw InputError("There is no normal contact law called \"" + name + "\"; " +
                     name_suggestion(name, names));
  }

  std::shared_ptr<const NormalLaw> create_normal_law(const std::string &name,
                                                     const std::vector<double> &numbers)
  {
    const NormalLawEntry &entry = find_normal_law(name);
    check_numbers(name, entry.parameters, numbers.size());
    return entry.make(numbers);
  }
} // namespace vibrocontact
