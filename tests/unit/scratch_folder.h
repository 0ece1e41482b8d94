#pragma once

#include <gtest/gtest.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

#include <unistd.h>

namespace vibrocontact
{
  /// A folder of this process alone, gone with it: several tests run at once, and write files of one name.
  inline std::string scratch_folder()
  {
    struct Folder
    {
      std::string name = testing::TempDir() + "vibrocontact_XXXXXX";
      const pid_t owner = getpid();

      Folder()
      {
        if (!mkdtemp(name.data()))
          throw std::filesystem::filesystem_error("no folder for files of a test", name,
                                                  std::error_code(errno, std::generic_category()));
      }
      ~Folder()
      {
        std::error_code ignored;
        if (getpid() == owner)
          std::filesystem::remove_all(name, ignored);
      }
    };
    static const Folder folder;
    return folder.name;
  }
} // namespace vibrocontact
