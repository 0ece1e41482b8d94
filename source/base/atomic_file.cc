#include <vibrocontact/base/atomic_file.h>
#include <vibrocontact/base/exceptions.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>

namespace vibrocontact
{
  namespace
  {
    namespace fs = std::filesystem;

    /// @param fill writes the file under the name given and returns whether that went well
    void write_whole(const std::string &file_name, const std::function<bool(const fs::path &)> &fill)
    {
      const fs::path path(file_name), part(unique_part(file_name));
      std::error_code error;
      if (path.has_parent_path())
        fs::create_directories(path.parent_path(), error);
      const bool filled = fill(part);
      if (filled)
        fs::rename(part, path, error);
      if (filled && !error)
        return;
      std::error_code ignored;
      fs::remove(part, ignored);
      throw OutputError("the file \"" + file_name +
                        "\" cannot be written; give a folder with write permission and free space");
    }
  } // namespace

  std::string unique_part(const std::string &file_name)
  {
    char host[256] = "host";
    gethostname(host, sizeof(host) - 1);
    return file_name + "." + host + "-" + std::to_string(getpid()) + ".part";
  }

  void write_file(const std::string &file_name, const std::string_view content)
  {
    write_whole(file_name,
                [&](const fs::path &part)
                {
                  std::ofstream file(part, std::ios::binary);
                  file << content;
                  file.close();
                  return static_cast<bool>(file);
                });
  }

  void copy_file(const std::string &from, const std::string &to)
  {
    std::error_code ignored;
    if (!fs::exists(from, ignored))
      throw OutputError("the file \"" + from + "\" that is to be copied to \"" + to +
                        "\" does not exist; it was deleted meanwhile: run again");
    write_whole(to,
                [&](const fs::path &part)
                {
                  std::error_code error;
                  return fs::copy_file(from, part, fs::copy_options::overwrite_existing, error);
                });
  }
} // namespace vibrocontact
