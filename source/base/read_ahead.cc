#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/parameter_text.h>
#include <vibrocontact/base/read_ahead.h>

#include <algorithm>

namespace vibrocontact
{
  std::string read_ahead_choice(const ParameterFile &file, const std::string &section,
                                const std::string &entry, const std::string &by_default,
                                const dealii::Patterns::Selection &choices)
  {
    const std::string value = file.raw_value(section, entry, by_default);
    return choices.match(value) ? value : by_default;
  }

  ListedNames read_ahead_names(const ParameterFile &file, const std::string &section,
                               const std::string &entry)
  {
    ListedNames names;
    names.listed = split_list(file.raw_value(section, entry));
    for (const std::string &name : names.listed)
      if (std::count(names.listed.begin(), names.listed.end(), name) > 1 ||
          name.find('/') != std::string::npos)
        throw InputError(file.where(section, entry) + ": the name \"" + name +
                         "\" is listed twice or has a / in it, which separates sections");
    const ParameterFile alone(file.file_name(), file.bytes());
    for (const std::string &name : split_list(alone.raw_value(section, entry)))
      if (std::count(names.listed.begin(), names.listed.end(), name) == 0)
        names.unlisted.push_back(name);
    return names;
  }
} // namespace vibrocontact
