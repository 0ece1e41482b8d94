#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/parameter_text.h>
#include <vibrocontact/scene/glued_parts.h>

#include <deal.II/base/utilities.h>

namespace vibrocontact
{
  std::vector<GluedPair> glued_pairs(const std::string &text, const std::string &entry)
  {
    std::vector<GluedPair> result;
    for (const std::string &item : dealii::Utilities::split_string_list(text, ';'))
    {
      const std::size_t colon = item.find(':');
      GluedPair pair{trimmed(item.substr(0, colon)),
                     colon == std::string::npos ? "" : trimmed(item.substr(colon + 1))};
      if (pair.follower.empty() || pair.leader.empty() || pair.leader.find(':') != std::string::npos)
        throw InputError(entry + " has \"" + item +
                         "\": give two groups with a colon between them, the finer one first, pairs apart by "
                         "semicolons, for instance pad back: plate front.");
      if (pair.follower == pair.leader)
        throw InputError(entry + " glues " + pair.follower +
                         " to itself: name the two groups that lie on each other.");
      for (const GluedPair &other : result)
        if (other.follower == pair.follower)
          throw InputError(entry + " has " + pair.follower +
                           " before the colon twice: what follows one group cannot follow another; give the "
                           "groups behind the colon one name in the mesh, or exchange a pair.");
      result.push_back(pair);
    }
    return result;
  }
} // namespace vibrocontact
