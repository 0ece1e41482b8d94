#include "readers.h"

#include <vibrocontact/base/blas.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/singleton_start.h>
#include <vibrocontact/base/utf8.h>

#include <deal.II/base/mpi.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <unistd.h>

namespace readers
{
  namespace
  {
    struct Session
    {
      Session(int &argc, char **&argv)
          : mpi(argc, argv, 1),
            // memory if there is such a disk
            folder(std::filesystem::path(std::filesystem::exists("/dev/shm") ? "/dev/shm" : ".") /
                   ("vibrocontact_readers_" + std::to_string(getpid())))
      {
        std::filesystem::create_directories(folder);
        std::filesystem::current_path(folder);
      }
      ~Session()
      {
        std::error_code ignored;
        std::filesystem::remove_all(folder, ignored);
      }
      vibrocontact::SingletonStart singleton;
      dealii::Utilities::MPI::MPI_InitFinalize mpi;
      std::filesystem::path folder;
    };
  } // namespace

  std::shared_ptr<void> start(char **argv)
  {
    // of the arguments, which are not for PETSc, only the name
    int one = 1;
    const auto session = std::make_shared<Session>(one, argv);
    vibrocontact::prepare_blas();
    dealii::deal_II_exceptions::disable_abort_on_exception();
    vibrocontact::run_log().set_screen(false);
    vibrocontact::run_log().open_file("/dev/null");
    std::cerr.rdbuf(nullptr); // of warnings that are expected
    return session;
  }

  bool taken(const std::function<void()> &read)
  {
    std::string message;
    try
    {
      read();
      return true;
    }
    catch (const vibrocontact::InputError &error)
    {
      message = error.what();
    }
    catch (const vibrocontact::ConvergenceError &error)
    {
      message = error.what();
    }
    if (message.empty() || vibrocontact::first_byte_outside_utf8(message) < message.size())
      throw std::logic_error("a refusal is no text in UTF-8: " + message);
    return false;
  }

  std::string file_of(const std::string &name, const std::string &bytes)
  {
    std::ofstream(name, std::ios::binary) << bytes;
    return name;
  }
} // namespace readers
