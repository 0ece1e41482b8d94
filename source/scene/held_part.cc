#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/parameter_text.h>
#include <vibrocontact/scene/held_part.h>

#include <algorithm>

namespace vibrocontact
{
  std::vector<HeldPart> held_parts(const std::vector<std::string> &items, const std::string &entry)
  {
    std::vector<HeldPart> result;
    for (const std::string &item : items)
    {
      const std::size_t colon = item.find(':');
      HeldPart part{trimmed(item.substr(0, colon)), {{true, true, true}}};
      if (colon != std::string::npos)
      {
        std::string named = item.substr(colon + 1);
        named.erase(std::remove(named.begin(), named.end(), ' '), named.end());
        if (named.empty() || named.find_first_not_of("xyz") != std::string::npos)
          throw InputError(entry + " has \"" + item +
                           "\": after the colon stand the directions that are held, out of x, y and z, for "
                           "instance " +
                           part.boundary + ": yz.");
        for (unsigned int d = 0; d < 3; ++d)
          part.directions[d] = named.find("xyz"[d]) != std::string::npos;
      }
      for (const HeldPart &other : result)
        if (other.boundary == part.boundary)
          throw InputError(entry + " names " + part.boundary + " twice: give it once, with all directions.");
      result.push_back(part);
    }
    return result;
  }
} // namespace vibrocontact
