#pragma once

#include <vibrocontact/run/program.h>

#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <sys/wait.h>
#include <tuple>
#include <unistd.h>
#include <vector>

/// A run of the program in a copy of this process: to load the program's libraries takes half a second.
struct RunInCopy
{
  std::vector<std::string> arguments;
  std::filesystem::path folder;
  /// files for its output
  std::filesystem::path screen, errors;
  /// after which it is ended [s]; 0: never
  unsigned int longest = 0;
};

/// Whatever is thrown ends this process.
[[noreturn]] inline void become_program(const RunInCopy &run) noexcept
{
  alarm(run.longest);
  const int to_write = O_WRONLY | O_CREAT | O_TRUNC;
  for (const auto &[file, descriptor, mode] : {std::tuple(run.screen, STDOUT_FILENO, to_write),
                                               {run.errors, STDERR_FILENO, to_write},
                                               {std::filesystem::path("/dev/null"), STDIN_FILENO, O_RDONLY}})
    if (dup2(open(file.c_str(), mode, 0644), descriptor) < 0)
      std::abort();
  std::filesystem::current_path(run.folder);
  std::vector<std::string> arguments = run.arguments;
  arguments.insert(arguments.begin(), PROGRAM_FILE);
  std::vector<char *> pointers;
  for (std::string &argument : arguments)
    pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  std::exit(vibrocontact::run_program(vibrocontact::standard_tables(), arguments.size(), pointers.data()));
}

/// @return as waitpid() has it
inline int status_of(const RunInCopy &run)
{
  const pid_t child = fork();
  if (child < 0)
    throw std::runtime_error("no process could be made");
  if (child == 0)
    become_program(run);
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR)
      throw std::runtime_error("a run was lost");
  return status;
}
