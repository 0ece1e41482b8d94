#pragma once

#include <vibrocontact/base/checkpoint_file.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace vibrocontact
{
  /// Numbers that tell bodies apart, by name.
  using Marks = std::vector<std::pair<std::string, std::vector<double>>>;

  /// share of a step by which its end may lie beyond the last time
  constexpr double rounding_of_times = 1e-6;

  /// Whole steps up to an end [s]; never beyond it, where tables may stop.
  inline double steps_until(const double end_time, const double time_step)
  {
    return std::floor(end_time / time_step + rounding_of_times);
  }

  /// A motion in time, found block of steps after block of steps by run_march() (marching/run_march.h). What happens in
  /// a step is the march's own; a virtual call for each block costs nothing.
  ///
  /// Every rank goes through the same steps and finds the same numbers. No member communicates.
  class March
  {
  public:
    virtual ~March() = default;
    /// how far it is and where its last step ends [s]
    virtual double time() const = 0;
    virtual double end_time() const = 0;
    virtual bool is_over() = 0;
    /// The steps up to the next place where a checkpoint may stand, shown to the recorders. A march that is continued
    /// there goes the same way bit for bit.
    /// @throws ConvergenceError if it cannot go on; what it found before stays
    virtual void advance_block() = 0;
    /// All that the next block depends on, and the sums so far.
    virtual void exchange(CheckpointFile &file) = 0;
    /// What a checkpoint has to agree with to be of the same bodies.
    virtual Marks marks() const = 0;
    /// How it goes, said beside the time left.
    virtual std::string pace() const { return ""; }
    /// The next n_steps of the block or what is left of it, between which a signal is heard of. A march of short blocks goes
    /// through all of it.
    virtual void advance_part(unsigned int /*n_steps*/) { advance_block(); }
    /// Whether a checkpoint may stand here.
    virtual bool is_between_blocks() const { return true; }
  };

  /// What a second march beside the first one tells about its error (numerics/doubled_step.h).
  struct MarchErrors
  {
    /// until when both were compared, 0: not at all [s]
    double time = 0;
    /// of the normal impulse and of the rms normal force until then, relative [-]
    double impulse = 0, rms_force = 0;
    /// what the second march took [s]: wall time of a transient, processor time of a modal convolution
    double seconds = 0;
    /// why it ended early, if it did
    std::string failure;

    void exchange(CheckpointFile &file)
    {
      file("errors/time", time);
      file("errors/impulse", impulse);
      file("errors/rms_force", rms_force);
      file("errors/seconds", seconds);
      file("errors/failure", failure);
    }
  };
} // namespace vibrocontact
