#pragma once

#include <string>
#include <string_view>

namespace vibrocontact
{
  /// Writes a file so that it appears whole or not at all: under a temporary name first, then renamed.
  /// Folders on the way are made. To be called by one rank.
  /// @throws OutputError if that is impossible (full disk, no permission)
  void write_file(const std::string &file_name, std::string_view content);

  /// Copies a file in the same way. @throws OutputError, with its own sentence if `from` is missing
  void copy_file(const std::string &from, const std::string &to);

  /// Temporary name beside a file, of this process alone: two runs may write the same file at once.
  std::string unique_part(const std::string &file_name);
} // namespace vibrocontact
