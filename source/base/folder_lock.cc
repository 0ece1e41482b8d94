#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/folder_lock.h>
#include <vibrocontact/base/log.h>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <thread>

namespace vibrocontact
{
  namespace fs = std::filesystem;

  namespace
  {
    std::string holder_text(const std::string &purpose)
    {
      char host[256] = "host", time[64] = "";
      gethostname(host, sizeof(host) - 1);
      const std::time_t now = std::time(nullptr);
      std::tm parts;
      std::strftime(time, sizeof time, "%Y-%m-%d %H:%M:%S", localtime_r(&now, &parts));
      return "process " + std::to_string(getpid()) + " on " + host + " since " + time + ", " + purpose;
    }

    /// The holder writes its name just after it has taken the lock: it is given a second.
    std::string holder_of_lock(const std::string &file_name)
    {
      for (unsigned int trial = 0; trial < 50; ++trial)
      {
        std::ifstream file(file_name);
        std::string line;
        if (std::getline(file, line) && !file.eof())
          return line;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
      }
      return "it has just begun";
    }
  } // namespace

  FolderLock::FolderLock(const std::string &folder, const std::string &purpose, const bool makes_folder)
      : folder(folder), name(folder + "/.vibrocontact_lock")
  {
    on_first_rank(
        [&]
        {
          std::error_code ignored;
          if (!makes_folder && !fs::is_directory(folder, ignored))
            return;
          try
          {
            acquire(purpose);
          }
          catch (...)
          {
            release();
            throw;
          }
        });
  }

  FolderLock::~FolderLock()
  {
    release();
  }

  void FolderLock::acquire(const std::string &purpose)
  {
    std::error_code ignored;
    for (fs::path path = fs::absolute(folder).lexically_normal();
         !fs::exists(path, ignored) && path.has_relative_path(); path = path.parent_path())
      first_made = path.string();
    for (unsigned int trial = 0;; ++trial)
    {
      fs::create_directories(folder, ignored);
      const int file = open(name.c_str(), O_RDWR | O_CREAT, 0666);
      // the run that ends may take the folder away in between
      if (file < 0 && errno == ENOENT && trial < 100)
        continue;
      if (file < 0)
        throw InputError("nothing can be written to the folder \"" + folder +
                         "\"; give a folder with write permission and free space, with --output or "
                         "Output/Directory");
      if (flock(file, LOCK_EX | LOCK_NB) != 0)
      {
        const int reason = errno;
        close(file);
        if (reason == EINTR)
          continue;
        if (reason == EWOULDBLOCK)
          throw InputError("another run writes to the folder \"" + folder + "\" (" + holder_of_lock(name) +
                           "): wait for its end, or give another folder with --output");
        run_log().warning("The file system of the folder \"" + folder +
                          "\" knows no locks: see that no other run writes there.");
        return;
      }
      struct stat own, there;
      // the run that had it may have removed the file, which is then another one's
      if (fstat(file, &own) != 0 || stat(name.c_str(), &there) != 0 || own.st_ino != there.st_ino ||
          own.st_dev != there.st_dev)
      {
        close(file);
        continue;
      }
      descriptor = file;
      const std::string text = holder_text(purpose) + "\n";
      if (ftruncate(file, 0) != 0 || write(file, text.data(), text.size()) < 0)
        run_log().warning("The lock of the folder \"" + folder +
                          "\" cannot say whose it is: is the disk full?");
      return;
    }
  }

  void FolderLock::release()
  {
    std::error_code ignored;
    if (descriptor >= 0)
    {
      fs::remove(name, ignored);
      close(descriptor);
      descriptor = -1;
    }
    if (first_made.empty())
      return;
    // those that are not empty stay
    const fs::path last = fs::path(first_made).parent_path();
    for (fs::path path = fs::absolute(folder).lexically_normal(); path != last && path.has_relative_path();
         path = path.parent_path())
      fs::remove(path, ignored);
    first_made.clear();
  }
} // namespace vibrocontact
