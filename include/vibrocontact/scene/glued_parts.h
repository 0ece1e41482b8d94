#pragma once

#include <string>
#include <vector>

namespace vibrocontact
{
  /// Two groups of faces that are glued: the first's motion follows the second's.
  struct GluedPair
  {
    std::string follower, leader;
  };

  /// What the entry Glued says: `pad back : plate front; rib : plate back`.
  /// @param entry where it stands, for messages @throws InputError for what is no pair, and for a group that follows twice
  std::vector<GluedPair> glued_pairs(const std::string &text, const std::string &entry);
} // namespace vibrocontact
