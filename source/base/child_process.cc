#include <vibrocontact/base/child_process.h>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace vibrocontact
{
  namespace
  {
    void set_limit(const int what, const double value)
    {
      rlimit limit;
      if (getrlimit(__rlimit_resource(what), &limit) != 0)
        return;
      limit.rlim_cur = std::min(limit.rlim_max, static_cast<rlim_t>(value));
      setrlimit(__rlimit_resource(what), &limit);
    }

    double address_space()
    {
      double pages = 0;
      std::ifstream("/proc/self/statm") >> pages;
      return pages * sysconf(_SC_PAGESIZE);
    }

    void write_all(const int file, const std::string &text)
    {
      for (std::size_t at = 0; at < text.size();)
      {
        const ssize_t n = write(file, text.data() + at, text.size() - at);
        if (n < 0 && errno != EINTR)
          _exit(2);
        at += std::max<ssize_t>(n, 0);
      }
    }

    [[noreturn]] void work_as_child(const std::function<std::string()> &work, const int out,
                                    const double seconds, const double bytes)
    {
      for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU})
        std::signal(signal, SIG_DFL);
      const int nowhere = open("/dev/null", O_RDWR);
      for (const int screen : {0, 1, 2})
        dup2(nowhere, screen);
      set_limit(RLIMIT_CORE, 0);
      set_limit(RLIMIT_CPU, seconds);
      set_limit(RLIMIT_AS, address_space() + bytes);
      std::string text;
      try
      {
        text = "+" + work();
      }
      catch (const std::string &error)
      {
        text = "-" + error;
      }
      catch (const std::exception &error)
      {
        text = std::string("-") + error.what();
      }
      catch (...)
      {
        text = "-an unknown error";
      }
      write_all(out, text);
      _exit(0);
    }
  } // namespace

  ChildResult run_in_child(const std::function<std::string()> &work, const double seconds, const double bytes)
  {
    int ends[2];
    if (pipe(ends) != 0)
      throw std::runtime_error(std::string("no pipe: ") + std::strerror(errno));
    const pid_t child = fork();
    if (child < 0)
    {
      close(ends[0]);
      close(ends[1]);
      throw std::runtime_error(std::string("no further process: ") + std::strerror(errno));
    }
    if (child == 0)
    {
      close(ends[0]);
      work_as_child(work, ends[1], seconds, bytes);
    }
    close(ends[1]);
    std::string text;
    char buffer[65536];
    for (ssize_t n = 1; n != 0;)
    {
      n = read(ends[0], buffer, sizeof buffer);
      if (n > 0)
        text.append(buffer, n);
      else if (n < 0 && errno != EINTR)
        break;
    }
    close(ends[0]);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR)
      ;
    ChildResult result;
    if (WIFSIGNALED(status))
    {
      result.crashed = true;
      result.error = "signal " + std::to_string(WTERMSIG(status));
    }
    else if (WEXITSTATUS(status) != 0 || text.empty())
    {
      result.crashed = true;
      result.error = "code " + std::to_string(WEXITSTATUS(status));
    }
    else if (text.front() == '-')
      result.error = text.substr(1);
    else
      result.output = text.substr(1);
    return result;
  }
} // namespace vibrocontact
