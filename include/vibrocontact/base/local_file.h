#pragma once

#include <string>

namespace vibrocontact
{
  /// Bytes of a file, read by whoever calls. @param entry that names it, for the message
  /// @throws InputError if it cannot be read
  std::string local_file(const std::string &file_name, const std::string &entry);

  /// Whether a file's name ends so, in small or capital letters. @param extension in small ones, with its point
  bool has_extension(const std::string &file_name, const std::string &extension);
} // namespace vibrocontact
