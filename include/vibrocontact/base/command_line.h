#pragma once

#include <string>
#include <vector>

namespace vibrocontact
{
  /// What the user asked for: `vibrocontact FILE.prm [options]`.
  struct CommandLine
  {
    /// parameter file; empty with --version, --help, --parameters
    std::string file;
    /// --output; empty: the entry Output/Directory
    std::string output;
    /// --set "Section/Sub/Entry=value", in the order given
    std::vector<std::string> overrides;
    bool check = false, parameters = false, resume = false, quiet = false, version = false, help = false;
  };

  /// @throws InputError on an unknown option, more than one file or none
  CommandLine read_command_line(int argc, const char *const *argv);

  /// The text of --help.
  std::string command_line_help();
} // namespace vibrocontact
