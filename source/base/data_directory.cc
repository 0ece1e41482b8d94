#include <vibrocontact/base/data_directory.h>

#include <filesystem>
#include <system_error>

namespace vibrocontact
{
  namespace
  {
    std::string &told()
    {
      static std::string directory;
      return directory;
    }
  } // namespace

  void set_data_directory(const std::string &directory)
  {
    told() = directory;
  }

  std::string data_directory()
  {
    namespace fs = std::filesystem;
    std::error_code failed;
    const fs::path program = fs::read_symlink("/proc/self/exe", failed);
    const std::string installed =
        (program.parent_path().parent_path() / VIBROCONTACT_DATA_DIRECTORY).string();
    for (const std::string &directory : {told(), installed})
      if (!directory.empty() && fs::is_directory(directory + "/meshes", failed))
        return directory;
    return VIBROCONTACT_SOURCE_DIRECTORY;
  }
} // namespace vibrocontact
