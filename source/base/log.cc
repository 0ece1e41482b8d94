#include <vibrocontact/base/log.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

namespace vibrocontact
{
  namespace
  {
    constexpr std::size_t name_width = 34;

    bool is_first_rank()
    {
      return !dealii::Utilities::MPI::job_supports_mpi() ||
             dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
    }

    double seconds_since(const std::chrono::steady_clock::time_point &begin)
    {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
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

  void Log::write(const std::string &text)
  {
    if (!is_first_rank())
      return;
    if (screen)
      std::cout << text << std::flush;
    if (file.is_open())
      file << text << std::flush;
    else
      kept += text;
  }

  void Log::block(const std::string &new_title)
  {
    end_block();
    title = new_title;
    block_begin = std::chrono::steady_clock::now();
    write("\n" + title + "\n");
  }

  void Log::end_block()
  {
    if (!title.empty() && seconds_since(block_begin) > 0.05)
      write("  " + padded("time") + time_text(seconds_since(block_begin)) + "\n");
    title.clear();
  }

  void Log::line(const std::string &text)
  {
    write("  " + text + "\n");
  }

  void Log::value(const std::string &name, const double number, const std::string &unit)
  {
    char digits[40];
    std::snprintf(digits, sizeof digits, "%.6g", number);
    write("  " + padded(name) + with_unit(digits, unit) + "\n");
  }

  void Log::value(const std::string &name, const int number, const std::string &unit)
  {
    write("  " + padded(name) + with_unit(std::to_string(number), unit) + "\n");
  }

  void Log::value(const std::string &name, const unsigned int number, const std::string &unit)
  {
    write("  " + padded(name) + with_unit(std::to_string(number), unit) + "\n");
  }

  void Log::value(const std::string &name, const unsigned long long number, const std::string &unit)
  {
    write("  " + padded(name) + with_unit(std::to_string(number), unit) + "\n");
  }

  void Log::value(const std::string &name, const std::string &text)
  {
    write("  " + padded(name) + text + "\n");
  }

  void Log::warning(const std::string &text)
  {
    ++warnings;
    if (is_first_rank() && !screen)
      std::cerr << "warning: " << text << std::endl;
    write("  WARNING: " + text + "\n");
  }

  Log &run_log()
  {
    static Log log;
    return log;
  }

  Progress::Progress(const std::string &what, const double n_steps)
      : what(what), total(n_steps), begin(std::chrono::steady_clock::now())
  {
  }

  void Progress::advance(const double n, const std::function<std::string()> &detail)
  {
    done += n;
    const double elapsed = seconds_since(begin);
    if (elapsed < next_report || done <= 0 || done >= total)
      return;
    next_report = elapsed + std::max(5., 0.25 * elapsed);
    char share[16];
    std::snprintf(share, sizeof share, "%.0f %%", 100 * done / total);
    run_log().line(what + ": " + share + ", " + time_text(elapsed * (total - done) / done) + " left" +
                   (detail ? ", " + detail() : ""));
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
