#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/local_file.h>
#include <vibrocontact/base/parameter_text.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace vibrocontact
{
  std::string local_file(const std::string &file_name, const std::string &entry)
  {
    std::ifstream file(file_name, std::ios::binary);
    std::error_code ignored;
    if (!file || std::filesystem::is_directory(file_name, ignored))
      throw InputError(
          entry + ": the file \"" + file_name +
          "\" cannot be read; give an existing one, beside the parameter file or in the working folder.");
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }

  bool has_extension(const std::string &file_name, const std::string &extension)
  {
    return lower_case(std::filesystem::path(file_name).extension().string()) == extension;
  }
} // namespace vibrocontact
