#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/data_directory.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/output/figures.h>

#include <filesystem>
#include <spawn.h>
#include <sys/wait.h>
#include <vector>

extern char **environ;

namespace vibrocontact
{
  namespace
  {
    /// Runs a program without a shell; its exit code, or -1 if it does not exist.
    int run_program(std::vector<std::string> words)
    {
      std::vector<char *> arguments;
      for (auto &word : words)
        arguments.push_back(word.data());
      arguments.push_back(nullptr);
      pid_t child;
      if (posix_spawnp(&child, arguments[0], nullptr, nullptr, arguments.data(), environ) != 0)
        return -1;
      int status = 0;
      if (waitpid(child, &status, 0) != child || !WIFEXITED(status))
        return -1;
      return WEXITSTATUS(status);
    }

    void draw(const std::string &folder, const std::string &option)
    {
      const std::string script = data_directory() + "/contrib/plot_results.py";
      if (!std::filesystem::exists(script))
      {
        run_log().line("no figures: " + script + " is not there");
        return;
      }
      // The exit code 4 says that this Python has no matplotlib (or h5py, which histories need); Debian's own
      // may have it.
      std::vector<std::string> command = {"", script, folder};
      if (!option.empty())
        command.insert(command.begin() + 2, option);
      int code = -1;
      for (const char *python : {"python3", "/usr/bin/python3"})
        if (code == -1 || code == 4 || code == 127)
        {
          command.front() = python;
          code = run_program(command);
        }
      if (code == 0)
        run_log().value("figures", folder + "/figures");
      else
        run_log().line(code == 4 || code == -1 || code == 127
                           ? "no figures: Python's matplotlib or h5py is not installed (python3-matplotlib, "
                             "python3-h5py)"
                           : "no figures: " + script + " left with code " + std::to_string(code));
    }
  } // namespace

  void draw_figures(const std::string &folder, const std::string &option)
  {
    on_first_rank([&] { draw(folder, option); });
  }
} // namespace vibrocontact
