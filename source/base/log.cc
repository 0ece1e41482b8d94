#include <vibrocontact/base/log.h>
#include <vibrocontact/base/run_communicator.h>
#include <vibrocontact/base/wall_clock.h>

#include <deal.II/base/mpi.h>

#include <pthread.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <thread>

namespace vibrocontact
{
  namespace
  {
    constexpr std::size_t name_width = 34;
    constexpr char clear_line[] = "\r\033[K";

    bool is_first_rank()
    {
      return !dealii::Utilities::MPI::job_supports_mpi() ||
             dealii::Utilities::MPI::this_mpi_process(run_communicator()) == 0;
    }

    std::string padded(const std::string &name)
    {
      return name.size() < name_width ? name + std::string(name_width - name.size(), ' ') : name + "  ";
    }

    std::string with_unit(const std::string &number, const std::string &unit)
    {
      return unit.empty() ? number : number + " " + unit;
    }
  } // namespace

  void Log::set_screen(const bool value)
  {
    screen = value;
  }

  void Log::open_file(const std::string &file_name, const bool append)
  {
    if (!is_first_rank())
      return;
    file.close();
    if (!file_name.empty())
    {
      file.open(file_name, append ? std::ios::app : std::ios::trunc);
      file << kept << std::flush;
    }
    kept.clear();
    if (!file_name.empty() && !file)
    {
      file.close();
      warning("the log \"" + file_name +
              "\" cannot be written; give a folder with write permission and free space");
    }
  }

  void Log::write(const std::string &text, const bool on_screen)
  {
    if (screen && on_screen)
    {
      const std::lock_guard<std::mutex> lock(screen_mutex);
      if (has_status)
        std::cout << clear_line;
      has_status = false;
      std::cout << text << std::flush;
    }
    if (file.is_open())
      file << text << std::flush;
    else
      kept += text;
  }

  void Log::say(const std::string &text, const bool on_screen)
  {
    if (title != heading && !title.empty())
      write("\n" + title + "\n", on_screen);
    heading = title;
    write("  " + text + "\n", on_screen);
  }

  namespace
  {
    /// Of the terminal, or as VIBROCONTACT_TERMINAL tells, which may be a number; 80 if nobody knows.
    unsigned int terminal_columns()
    {
      winsize size = {};
      if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 20)
        return size.ws_col;
      const char *const told = std::getenv("VIBROCONTACT_TERMINAL");
      const int columns = told ? std::atoi(told) : 0;
      return columns > 20 ? columns : 80;
    }
  } // namespace

  bool Log::on_terminal() const
  {
    // mpirun gives every rank a terminal of its own, wherever its own output goes: contrib/run.sh tells; so does who reads
    // a pipe as if it were one
    static const bool started_by_mpirun = std::getenv("PMIX_RANK") || std::getenv("OMPI_COMM_WORLD_RANK"),
                      is_terminal = std::getenv("VIBROCONTACT_TERMINAL") != nullptr ||
                                    (!started_by_mpirun && isatty(STDOUT_FILENO) == 1);
    return screen && is_terminal;
  }

  void Log::status(const std::string &text)
  {
    if (!on_terminal())
      return;
    const std::lock_guard<std::mutex> lock(screen_mutex);
    // a line that breaks cannot be replaced
    const std::size_t width = terminal_columns() - 1;
    if (has_status || !text.empty())
      std::cout << clear_line << text.substr(0, width) << std::flush;
    has_status = !text.empty();
  }

  void Log::block(const std::string &new_title)
  {
    if (!is_first_rank())
      return;
    end_block();
    title = new_title;
    heading.clear();
    block_begin = WallClock::now();
  }

  void Log::end_block()
  {
    // behind the lines of a part it would be taken for the part's
    const bool is_last = heading.empty() || heading == title;
    if (!title.empty() && is_last && seconds_since(block_begin) > 0.05)
      line(padded("time") + time_text(seconds_since(block_begin)));
    title.clear();
  }

  Log::Part::Part(const std::string &title)
  {
    outer = run_log().title;
    run_log().title = title;
  }

  Log::Part::~Part()
  {
    run_log().title = outer;
  }

  void Log::line(const std::string &text)
  {
    if (is_first_rank())
      say(text);
  }

  void Log::value(const std::string &name, const double number, const std::string &unit)
  {
    char digits[40];
    std::snprintf(digits, sizeof digits, "%.6g", number);
    line(padded(name) + with_unit(digits, unit));
  }

  void Log::value(const std::string &name, const int number, const std::string &unit)
  {
    line(padded(name) + with_unit(std::to_string(number), unit));
  }

  void Log::value(const std::string &name, const unsigned int number, const std::string &unit)
  {
    line(padded(name) + with_unit(std::to_string(number), unit));
  }

  void Log::value(const std::string &name, const unsigned long long number, const std::string &unit)
  {
    line(padded(name) + with_unit(std::to_string(number), unit));
  }

  void Log::value(const std::string &name, const std::string &text)
  {
    line(padded(name) + text);
  }

  void Log::warning(const std::string &text)
  {
    ++warnings;
    if (is_first_rank() && !screen && errors)
      std::cerr << "warning: " << text << std::endl;
    line("WARNING: " + text);
  }

  namespace
  {
    Log *&current_log()
    {
      static Log of_the_run;
      static Log *current = &of_the_run;
      return current;
    }
  } // namespace

  Log &run_log()
  {
    return *current_log();
  }

  Log::Aside::Aside(const std::string &file_name, const bool append) : outer(current_log())
  {
    own.screen = own.errors = false;
    own.open_file(file_name, append);
    current_log() = &own;
  }

  Log::Aside::~Aside()
  {
    own.end_block();
    current_log() = outer;
  }

  /// Keeps the status on the terminal current, second by second, in a thread of its own.
  struct Progress::Clock
  {
    explicit Clock(const Progress &progress)
    {
      // signals are the main thread's
      sigset_t all, before;
      sigfillset(&all);
      pthread_sigmask(SIG_SETMASK, &all, &before);
      thread = std::thread(
          [this, &progress]
          {
            std::unique_lock<std::mutex> lock(mutex);
            while (!stop.wait_for(lock, std::chrono::seconds(1), [this] { return stops; }))
              if (progress.log.current_progress == &progress)
                progress.log.status("  " + progress.text(seconds_since(progress.begin)));
          });
      pthread_sigmask(SIG_SETMASK, &before, nullptr);
    }
    ~Clock()
    {
      {
        const std::lock_guard<std::mutex> lock(mutex);
        stops = true;
      }
      stop.notify_one();
      thread.join();
    }

    bool stops = false;
    /// of what text() reads, and of `stops`
    std::mutex mutex;
    std::condition_variable stop;
    std::thread thread;
  };

  Progress::Progress(const std::string &what, const double n_steps, const double expected)
      : log(run_log()), what(what), total(n_steps), expected(expected), begin(WallClock::now()),
        outer(log.current_progress.exchange(this))
  {
    if (!is_first_rank())
      return;
    if (expected >= next_line)
      log.say(what + ": about " + time_text(std::ceil(expected)), !log.on_terminal());
    if (log.on_terminal())
      clock = std::make_unique<Clock>(*this);
  }

  Progress::~Progress()
  {
    clock.reset();
    log.current_progress = outer;
    if (is_first_rank())
      log.status("");
  }

  std::string Progress::text(const double seconds) const
  {
    std::string text = what + ": ";
    if (done > 0)
    {
      char share[16];
      std::snprintf(share, sizeof share, "%.0f %%, ", std::min(99., 100 * done / total));
      text += share;
    }
    text += time_text(std::floor(seconds));
    const double whole = done > 0 ? seconds_done * total / done : expected;
    if (whole > seconds)
      text += ", about " + time_text(std::ceil(whole - seconds)) + " left";
    return text + (detail.empty() ? "" : ", " + detail);
  }

  void Progress::advance(const double n, const std::function<std::string()> &details)
  {
    if (!is_first_rank())
      return;
    const double seconds = seconds_since(begin);
    std::unique_lock<std::mutex> lock;
    if (clock)
      lock = std::unique_lock<std::mutex>(clock->mutex);
    done += n;
    seconds_done = seconds;
    const bool line_is_due = seconds >= next_line && done < total;
    if (details && (line_is_due || (clock && seconds >= next_detail)))
    {
      next_detail = seconds + 1;
      detail = details();
    }
    if (!line_is_due)
      return;
    next_line = 2 * seconds;
    log.say(text(seconds), !log.on_terminal());
  }

  std::string time_text(const double seconds)
  {
    char text[40];
    if (seconds < 60)
      std::snprintf(text, sizeof text, "%.3g s", seconds);
    else
      std::snprintf(text, sizeof text, "%d min %02d s", static_cast<int>(seconds / 60),
                    static_cast<int>(std::fmod(seconds, 60.)));
    return text;
  }
} // namespace vibrocontact
