#pragma once

#include <cstddef>
#include <string>
#include <unordered_map>

namespace vibrocontact
{
  /// Physical group of each element of a gmsh file of format 2, by the element's number, 0: none; empty for other formats.
  ///
  /// In this format each element has a group of its own. gmsh's library keeps groups by geometrical entity, and makes
  /// one group of all if a program (meshio for instance) wrote the same entity for each element.
  /// @throws InputError for a binary file of the other byte order
  std::unordered_map<std::size_t, unsigned int> physical_tags_of_format_2(const std::string &file);
} // namespace vibrocontact
