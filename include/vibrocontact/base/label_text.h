#pragma once

#include <algorithm>
#include <string>

namespace vibrocontact
{
  /// A label such as axial(0,2)#2 as parameter files can hold it, to whose readers # begins a comment: axial(0,2)/2.
  inline std::string label_in_a_file(std::string label)
  {
    std::replace(label.begin(), label.end(), '#', '/');
    return label;
  }

  /// The same in a table, to whose readers a comma ends the column: axial(0;2)/2.
  inline std::string label_in_a_table(const std::string &label)
  {
    std::string result = label_in_a_file(label);
    std::replace(result.begin(), result.end(), ',', ';');
    return result;
  }
} // namespace vibrocontact
