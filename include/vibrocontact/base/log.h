#pragma once

#include <atomic>
#include <chrono>
#include <fstream>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

namespace vibrocontact
{
  class Progress;

  /// What the user reads while the program works: the screen and log.txt, written by rank 0 alone.
  ///
  ///     Wheel                                             <- block(): one per step
  ///       dofs                          258342            <- value(): name, number, unit
  ///       mass                          314.86 kg
  ///       WARNING: ...                                    <- warning(), counted
  ///       time                          3.2 s             <- by the next block()
  ///
  /// Lines written before open_file() are kept and head the file, so that the output folder can be made after
  /// the input has been checked. `--quiet` silences the screen, never the file; warnings reach standard
  /// error. Any code may write to it through run_log(); calls on other ranks than 0 do nothing.
  ///
  /// On a terminal the last line may be one that tells how far a long step is (Progress): the next line takes its
  /// place, and no file ever has it.
  class Log
  {
  public:
    /// Whether rank 0 writes to standard output (default yes).
    void set_screen(bool screen);
    /// Writes to this file from now on, first everything said so far; behind what an earlier run left there
    /// if this one resumes it. An empty name closes the file.
    void open_file(const std::string &file_name, bool append = false);

    /// Begins the block of a step; closes the one before with its wall time. The title is written with the first line.
    void block(const std::string &title);
    /// Closes the block with its wall time.
    void end_block();
    /// A step inside another one: what is said meanwhile stands under its title, what is said after it again under the
    /// title that was there before. Nothing is written if nothing is said.
    class Part
    {
    public:
      explicit Part(const std::string &title);
      ~Part();
      Part(const Part &) = delete;
      Part &operator=(const Part &) = delete;

    private:
      std::string outer;
    };
    /// One indented line of text.
    void line(const std::string &text);
    /// "name  value unit", six significant digits.
    void value(const std::string &name, double number, const std::string &unit = "");
    void value(const std::string &name, int number, const std::string &unit = "");
    void value(const std::string &name, unsigned int number, const std::string &unit = "");
    void value(const std::string &name, unsigned long long number, const std::string &unit = "");
    void value(const std::string &name, const std::string &text);
    void warning(const std::string &text);
    /// Warnings so far.
    unsigned int n_warnings() const { return warnings; }

    /// While it lives, run_log() of this rank is a log of its own that goes to a file and nowhere else: that of a case
    /// which this rank computes alone (SingleRank). Made after the SingleRank.
    class Aside;

  private:
    friend class Progress;

    /// An indented line under its heading.
    void say(const std::string &text, bool on_screen = true);
    void write(const std::string &text, bool on_screen = true);
    bool on_terminal() const;
    /// The line that the next one replaces, on a terminal only; empty: none.
    void status(const std::string &text);

    /// warnings go to standard error where nothing goes to the screen
    bool screen = true, errors = true, has_status = false;
    /// the innermost, which has the line
    std::atomic<Progress *> current_progress{nullptr};
    unsigned int warnings = 0;
    /// title of the block or part, and the one that the last line stands under
    std::string kept, title, heading;
    std::chrono::steady_clock::time_point block_begin;
    std::ofstream file;
    /// the clock of a Progress writes its status
    std::mutex screen_mutex;
  };

  /// The log of this run, or of the case that this rank computes alone.
  Log &run_log();

  class Log::Aside
  {
  public:
    /// @param append behind what an earlier run left in the file
    Aside(const std::string &file_name, bool append);
    ~Aside();
    Aside(const Aside &) = delete;
    Aside &operator=(const Aside &) = delete;

  private:
    Log own;
    Log *const outer;
  };

  /// Progress of a long step: how far it is and the time left, from the start if that is known beforehand. On a terminal
  /// one line is kept current, also while nothing advances (a factorisation is one call). Elsewhere, and in the file,
  /// the expected time is said first, if it is long, and how far it is ever more rarely: after 5, 10, 20, 40, ... seconds.
  ///
  /// Steps are assumed to cost the same; give advance() weights if they do not. Of steps inside each other the innermost
  /// has the line.
  class Progress
  {
  public:
    /// @param what said in front, e.g. "wheel: modes"; @param n_steps total of what advance() will add
    /// @param expected what is known beforehand of the time it takes [s]; 0: nothing
    Progress(const std::string &what, double n_steps, double expected = 0);
    ~Progress();
    Progress(const Progress &) = delete;
    Progress &operator=(const Progress &) = delete;

    /// @param detail said behind the time left, when that is said
    void advance(double n = 1, const std::function<std::string()> &detail = {});

  private:
    struct Clock;

    std::string text(double seconds) const;

    Log &log;
    std::string what, detail;
    double total, expected, done = 0, seconds_done = 0, next_line = 5, next_detail = 0;
    std::chrono::steady_clock::time_point begin;
    Progress *outer;
    std::unique_ptr<Clock> clock;
  };

  /// Seconds as a reader likes them: "0.034 s", "12.3 s", "4 min 05 s".
  std::string time_text(double seconds);
} // namespace vibrocontact
