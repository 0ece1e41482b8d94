#pragma once

#include <vibrocontact/scene/matrix_nodes.h>

#include <functional>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// A card of Nastran's bulk data with its continuation lines: short fields of 8 columns, long ones of 16 (`DMIG*`) or free
  /// ones between commas.
  struct NastranCard
  {
    std::string source;
    /// in capital letters, without `*`
    std::string name;
    /// all fields behind the name: 8 for each line of the card, 4 for each of long fields; without blanks
    std::vector<std::string> fields;
    /// line of the file on which each field stands
    std::vector<unsigned int> lines;

    /// empty if the card is shorter
    const std::string &field(std::size_t k) const;
    /// "source, line 7,"
    std::string where(std::size_t k = 0) const;
    /// A number as Nastran writes it: 1.5, 1.5E3, 1.5D3 or 1.5+3. @throws InputError
    double number(std::size_t k) const;
    /// @throws InputError
    unsigned long count(std::size_t k) const;
  };

  /// Hands every card of one of some names to a function, in the order of the file.
  void for_each_card(const std::string &source, const std::string &bytes,
                     const std::vector<std::string> &names,
                     const std::function<void(const NastranCard &)> &take);

  /// Places of the cards GRID. @throws InputError for a node in a coordinate system of its own
  NodePlaces read_grid_cards(const std::string &source, const std::string &bytes);
} // namespace vibrocontact
