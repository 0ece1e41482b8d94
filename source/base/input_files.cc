#include <vibrocontact/base/input_files.h>
#include <vibrocontact/base/parameter_text.h>

#include <boost/crc.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace vibrocontact
{
  std::string fingerprint(const std::string &file_name)
  {
    std::ifstream file(file_name, std::ios::binary);
    if (file_name.empty() || !file || std::filesystem::is_directory(file_name))
      return "";
    const std::string content((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    boost::crc_32_type checksum;
    checksum.process_bytes(content.data(), content.size());
    return std::to_string(content.size()) + " bytes, crc " + std::to_string(checksum.checksum());
  }

  bool names_input_file(const DeclaredParameters::Entry &entry)
  {
    return entry.pattern.rfind("[FileName", 0) == 0 && entry.pattern.find("output") == std::string::npos;
  }

  std::map<std::string, std::string> input_files(const DeclaredParameters &parameters)
  {
    std::map<std::string, std::string> files;
    for (const DeclaredParameters::Entry &entry : parameters.entries)
      if (names_input_file(entry) && !entry.value.empty())
        files[joined_path(entry.section, entry.name)] = fingerprint(entry.value);
    return files;
  }
} // namespace vibrocontact
