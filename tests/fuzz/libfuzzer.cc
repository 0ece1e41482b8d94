// The reader named by READER as a target of libFuzzer.
#include "readers.h"

#include <csignal>
#include <cstddef>
#include <cstdint>
#include <sanitizer/lsan_interface.h>

extern "C" const char *__lsan_default_suppressions();
extern "C" int LLVMFuzzerInitialize(int *, char ***argv);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size);

// HDF5 does not give back all of its memory when it refuses a damaged file.
extern "C" const char *__lsan_default_suppressions()
{
  return "leak:libhdf5";
}

extern "C" int LLVMFuzzerInitialize(int *, char ***argv)
{
  // MPI is never ended, and what it and its plug-ins never give back is no leak of a reader
  const __lsan::ScopedDisabler no_leaks;
  static auto *const session = new std::shared_ptr<void>(readers::start(*argv));
  (void)session;
  // nor are signals MPI's and PETSc's: libFuzzer sets its handlers only where there is none
  for (const int number : {SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSEGV, SIGTERM})
    std::signal(number, SIG_DFL);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  readers::READER(std::string(reinterpret_cast<const char *>(data), size));
  return 0;
}
