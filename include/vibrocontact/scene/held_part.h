#pragma once

#include <vibrocontact/scene/elastic_model.h>

#include <array>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// What an item of an entry such as Held says: `right` holds all directions, `right: yz` those named alone.
  struct HeldPart
  {
    std::string boundary;
    std::array<bool, 3> directions;

    bool holds_all() const { return directions[0] && directions[1] && directions[2]; }
  };

  /// @param entry where it stands, for messages @throws InputError if the directions are none
  std::vector<HeldPart> held_parts(const std::vector<std::string> &items, const std::string &entry);
} // namespace vibrocontact
