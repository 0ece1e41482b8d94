#pragma once

#include <string>
#include <vector>

namespace vibrocontact
{
  /// Least number of letters inserted, removed, changed or swapped with their neighbour that turns a into b;
  /// upper and lower case count as equal.
  unsigned int edit_distance(const std::string &a, const std::string &b);

  /// The names a user may have meant, nearest first, at most three: those within a third of the name's
  /// length.
  std::vector<std::string> nearest_names(const std::string &name, const std::vector<std::string> &candidates);

  /// Names in quotes: "a", "b" or "c".
  std::string quoted_list(const std::vector<std::string> &names, const std::string &last_word = "or");

  /// The end of a sentence about an unknown name: the nearest names, or else all that are valid
  /// (the first twelve), e.g. `did you mean "Spin"?` or `valid are "a" and "b"`.
  std::string name_suggestion(const std::string &name, const std::vector<std::string> &candidates);
} // namespace vibrocontact
