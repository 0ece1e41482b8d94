#include <vibrocontact/base/atomic_file.h>
#include <vibrocontact/base/exceptions.h>

#include <filesystem>
#include <fstream>

namespace vibrocontact
{
  void write_file(const std::string &file_name, const std::string &content)
  {
    namespace fs = std::filesystem;
    const fs::path path(file_name), part(file_name + ".part");
    std::error_code error;
    if (path.has_parent_path())
      fs::create_directories(path.parent_path(), error);
    std::ofstream file(part, std::ios::binary);
    file << content;
    file.close();
    if (file)
      fs::rename(part, path, error);
    if (!file || error)
    {
      fs::remove(part, error);
      throw InputError(
          "the file \"" + file_name + "\" cannot be written" +
          "; give a folder with write permission and free space, with --output or Output/Directory");
    }
  }
} // namespace vibrocontact
