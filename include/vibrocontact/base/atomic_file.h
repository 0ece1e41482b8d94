#pragma once

#include <string>

namespace vibrocontact
{
  /// Writes a file so that it appears whole or not at all: under a temporary name first, then renamed.
  /// Folders on the way are made. To be called by one rank.
  /// @throws InputError if the folder cannot be written to (full disk, no permission)
  void write_file(const std::string &file_name, const std::string &content);
} // namespace vibrocontact
