#pragma once

#include <vibrocontact/base/checkpoint_file.h>

#include <memory>
#include <string>
#include <vector>

struct sf_private_tag;

namespace vibrocontact
{
  /// A velocity as WAV while it is being computed: one channel, 48 kHz, 32-bit floating point, so that nothing is clipped; 1.0 is
  /// `full scale`. It grows as `<file>.part`, which players open, and takes its name at the end.
  ///
  /// The sound is the band-limited signal through the samples (Shannon), with a Kaiser window of 100 dB in place of an endless
  /// sinc: from 0.92 to 1 times half the lower rate it falls to nothing, so that nothing above folds back. It is silent before and
  /// after, faded over 2 ms at both ends. Memory holds the samples of the window, a few ms, and up to a second of sound.
  ///
  /// On one rank.
  class SoundStream
  {
  public:
    /// @param file_name of the WAV @param begin time of the first sample [s] @param step between samples [s] @param full_scale [m/s]
    SoundStream(const std::string &file_name, double begin, double step, double full_scale);
    ~SoundStream();
    SoundStream(SoundStream &&) noexcept;

    /// @throws OutputError
    void add(double velocity);
    /// Under a name in a checkpoint: what is known goes to the file; or goes on there. @throws OutputError, RowsLost if the
    /// file is gone or shorter than the checkpoint says
    void exchange(const std::string &name, CheckpointFile &checkpoint);
    /// @param at_the_end false: the run may be resumed, the file keeps its `.part` @throws OutputError
    void finish(bool at_the_end);
    /// of what is in the file [m/s]
    double largest() const { return largest_value; }

  private:
    /// Samples of the sound up to this time since the first sample [s].
    void make_until(double time);
    double sound_at(double time) const;
    /// All that wait but the last so many.
    void write(std::size_t n_kept);
    /// With a header that counts it.
    void bring_to_disk();
    void open();
    /// Those that the checkpoint counts. @throws OutputError, RowsLost
    void take_earlier_samples(const std::string &earlier);

    const std::string name;
    const double begin, step, full_scale;
    /// half the length of the window [s], its values times the sinc from 0 on [1/s]
    double half_window;
    std::vector<double> kernel;
    /// latest samples, number of the first of them, samples so far
    std::vector<double> recent;
    unsigned long first_recent = 0, n_samples = 0;
    /// of the sound: samples that wait for the fade at the end, samples in the file, samples made
    std::vector<double> waiting;
    unsigned long n_written = 0, n_made = 0;
    double largest_value = 0;
    std::unique_ptr<sf_private_tag, int (*)(sf_private_tag *)> file;
  };
} // namespace vibrocontact
