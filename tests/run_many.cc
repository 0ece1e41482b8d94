/// run_many: the program, once for each line of standard input, for many_runs.py.
///
/// A line is a JSON object: the folder to run in, the files for its output (screen, errors), and the program's arguments. Answered by a
/// line with the exit code, or minus the signal that ended it.

#include "run_in_copy.h"

#include <nlohmann/json.hpp>

#include <iostream>

int main()
{
  for (std::string line; std::getline(std::cin, line);)
  {
    const nlohmann::json request = nlohmann::json::parse(line);
    const int status =
        status_of({request.at("arguments"), request.at("folder").get<std::string>(),
                   request.at("screen").get<std::string>(), request.at("errors").get<std::string>()});
    std::cout << (WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status)) << std::endl;
  }
  return 0;
}
