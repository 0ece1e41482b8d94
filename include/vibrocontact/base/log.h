#pragma once

#include <chrono>
#include <fstream>
#include <functional>
#include <string>

namespace vibrocontact
{
  /// What the user reads while the program works: the screen and log.txt, written by rank 0 alone.
  ///
  ///     Wheel                                             <- block(): one per step
  ///       dofs                          258 342           <- value(): name, number, unit
  ///       mass                          314.86 kg
  ///       WARNING: ...                                    <- warning(), counted
  ///     Wheel: 3.2 s                                      <- done by the next block()
  ///
  /// Lines written before open_file() are kept and head the file, so that the output folder can be made after
  /// the input has been checked. `--quiet` silences the screen, never the file; warnings reach standard
  /// error. Any code may write to it through run_log(); calls on other ranks than 0 do nothing.
  class Log
  {
  public:
    /// Whether rank 0 writes to standard output (default yes).
    void set_screen(bool screen);
    /// Writes to this file from now on, first everything said so far; behind what an earlier run left there
    /// if this one resumes it. An empty name closes the file.
    void open_file(const std::string &file_name, bool append = false);

    /// Begins the block of a step; closes the one before with its wall time.
    void block(const std::string &title);
    /// Closes the block with its wall time.
    void end_block();
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

  private:
    void write(const std::string &text);

    bool screen = true;
    unsigned int warnings = 0;
    std::string kept, title;
    std::chrono::steady_clock::time_point block_begin;
    std::ofstream file;
  };

  /// The log of this run.
  Log &run_log();

  /// Progress of a long step: says how far it is and the time left, first after 3 s, then ever more rarely.
  /// Steps are assumed to cost the same; give advance() weights if they do not.
  class Progress
  {
  public:
    /// @param what shown in front, e.g. "modes"; @param n_steps total of what advance() will add
    Progress(const std::string &what, double n_steps);
    /// @param detail said behind the time left, when that is said
    void advance(double n = 1, const std::function<std::string()> &detail = {});

  private:
    std::string what;
    double total, done = 0, next_report = 3;
    std::chrono::steady_clock::time_point begin;
  };

  /// Seconds as a reader likes them: "0.034 s", "12.3 s", "4 min 05 s".
  std::string time_text(double seconds);
} // namespace vibrocontact
