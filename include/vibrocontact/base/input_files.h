#pragma once

#include <vibrocontact/base/declared_parameters.h>

#include <map>
#include <string>

namespace vibrocontact
{
  /// Size and checksum of a file; empty if there is none of this name.
  std::string fingerprint(const std::string &file_name);

  /// Fingerprints of the files that entries name, by the path of the entry; those that are written are left out.
  std::map<std::string, std::string> input_files(const DeclaredParameters &parameters);

  /// Whether an entry names a file that is read.
  bool names_input_file(const DeclaredParameters::Entry &entry);
} // namespace vibrocontact
