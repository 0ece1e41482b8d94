#include <vibrocontact/base/atomic_file.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/row_file.h>
#include <vibrocontact/marching/sound.h>
#include <vibrocontact/marching/sound_stream.h>

#include <deal.II/base/numbers.h>

#include <sndfile.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace vibrocontact
{
  namespace fs = std::filesystem;

  namespace
  {
    constexpr double pi = dealii::numbers::PI;
    /// what is left of lines beyond half the lower rate [dB], and from which part of it on they fall (resampled())
    constexpr double attenuation = 100, full_band = 0.92;
    /// of the kernel between 0 and the end of its window
    constexpr unsigned int n_kernel = 1 << 15;
    /// at both ends, in samples of the sound: 2 ms
    constexpr unsigned int n_fade = sound_rate / 500;

    double fade(const unsigned long k)
    {
      return k < n_fade ? 0.5 - 0.5 * std::cos(pi * k / n_fade) : 1.;
    }
  } // namespace

  SoundStream::SoundStream(const std::string &file_name, const double begin, const double step,
                           const double full_scale)
      : name(file_name), begin(begin), step(step), full_scale(full_scale), file(nullptr, sf_close)
  {
    // J. F. Kaiser's formulas for the length and the shape of a window
    const double limit = 0.5 * std::min<double>(sound_rate, 1 / step), flank = (1 - full_band) * limit,
                 shape = 0.1102 * (attenuation - 8.7);
    half_window = (attenuation - 8) / (2.285 * 2 * pi * flank) / 2;
    const double cut = limit - flank / 2;
    for (unsigned int k = 0; k <= n_kernel; ++k)
    {
      const double share = double(k) / n_kernel, x = 2 * pi * cut * share * half_window;
      kernel.push_back(2 * cut * (k == 0 ? 1 : std::sin(x) / x) *
                       std::cyl_bessel_i(0, shape * std::sqrt(1 - share * share)) /
                       std::cyl_bessel_i(0, shape));
    }
  }

  SoundStream::~SoundStream() = default;
  SoundStream::SoundStream(SoundStream &&) noexcept = default;

  void SoundStream::add(const double velocity)
  {
    recent.push_back(velocity);
    ++n_samples;
    make_until((n_samples - 1) * step - half_window);
    // half of what is kept is in use, so that moving costs nothing
    const double oldest = double(n_made) / sound_rate - half_window;
    const auto unused = static_cast<unsigned long>(std::max(0., std::floor(oldest / step))) - first_recent;
    if (unused > recent.size() / 2 && oldest > 0)
    {
      recent.erase(recent.begin(), recent.begin() + unused);
      first_recent += unused;
    }
    if (waiting.size() > sound_rate)
      write(n_fade);
  }

  double SoundStream::sound_at(const double time) const
  {
    const double from = std::max<double>(first_recent, std::ceil((time - half_window) / step)),
                 to = std::min(n_samples - 1., std::floor((time + half_window) / step));
    double sum = 0;
    for (double i = from; i <= to; ++i)
    {
      const double place = std::min(1., std::abs(time - i * step) / half_window) * n_kernel;
      const auto k = std::min<unsigned int>(place, n_kernel - 1);
      sum += recent[static_cast<unsigned long>(i) - first_recent] *
             (kernel[k] + (place - k) * (kernel[k + 1] - kernel[k]));
    }
    return sum * step;
  }

  void SoundStream::make_until(const double time)
  {
    for (; double(n_made) / sound_rate <= time; ++n_made)
      waiting.push_back(fade(n_made) * sound_at(double(n_made) / sound_rate));
  }

  void SoundStream::open()
  {
    const std::string part = name + ".part", now = n_written > 0 ? part + ".resumed" : part,
                      text = text_of_full_scale(full_scale, begin);
    SF_INFO info = {};
    info.samplerate = sound_rate;
    info.channels = 1;
    info.format = SF_FORMAT_WAV | SF_FORMAT_FLOAT;
    file.reset(sf_open(now.c_str(), SFM_WRITE, &info));
    if (file) // the chunk of the peak has the time of the day
      sf_command(file.get(), SFC_SET_ADD_PEAK_CHUNK, nullptr, SF_FALSE);
    if (!file || sf_set_string(file.get(), SF_STR_COMMENT, text.c_str()) != 0)
      throw OutputError("Cannot write the file '" + now + "': check the folder and its rights.");
    if (n_written == 0)
      return write_file(name + ".txt", text);
    take_earlier_samples(fs::exists(part) ? part : name);
    // killed before more comes, it holds what the checkpoint counts
    bring_to_disk();
    std::error_code error;
    fs::rename(now, part, error);
    if (error)
      throw OutputError("Cannot rename the file '" + now + "': check the folder and its rights.");
  }

  void SoundStream::take_earlier_samples(const std::string &earlier)
  {
    // libsndfile does not change files that have a comment
    SF_INFO info = {};
    const std::unique_ptr<SNDFILE, int (*)(SNDFILE *)> from(sf_open(earlier.c_str(), SFM_READ, &info),
                                                            sf_close);
    sf_count_t left = n_written;
    std::vector<float> block(sound_rate);
    while (from && info.samplerate == int(sound_rate) && info.channels == 1 && left > 0)
    {
      const sf_count_t n = std::min<sf_count_t>(left, block.size());
      if (sf_read_float(from.get(), block.data(), n) != n)
        break;
      if (sf_write_float(file.get(), block.data(), n) != n)
        throw OutputError("Cannot write the file '" + name + ".part': check the space on the disk.");
      left -= n;
    }
    if (left > 0)
      throw RowsLost("The checkpoint counts " + std::to_string(n_written) + " samples of the sound in \"" +
                     earlier + "\", which is gone, shorter or another file: run the file without --resume.");
  }

  void SoundStream::bring_to_disk()
  {
    sf_command(file.get(), SFC_UPDATE_HEADER_NOW, nullptr, 0);
    sf_write_sync(file.get());
  }

  void SoundStream::write(const std::size_t n_kept)
  {
    if (waiting.size() <= n_kept)
      return;
    if (!file)
      open();
    const std::size_t n = waiting.size() - n_kept;
    std::vector<double> samples(waiting.begin(), waiting.begin() + n);
    for (double &sample : samples)
    {
      largest_value = std::max(largest_value, std::abs(sample));
      sample /= full_scale;
    }
    if (sf_write_double(file.get(), samples.data(), n) != static_cast<sf_count_t>(n))
      throw OutputError("Cannot write the file '" + name + ".part': check the space on the disk.");
    bring_to_disk();
    waiting.erase(waiting.begin(), waiting.begin() + n);
    n_written += n;
  }

  void SoundStream::exchange(const std::string &label, CheckpointFile &checkpoint)
  {
    if (!checkpoint.reading())
      write(n_fade);
    checkpoint(label + "/recent", recent);
    checkpoint(label + "/first_recent", first_recent);
    checkpoint(label + "/samples", n_samples);
    checkpoint(label + "/waiting", waiting);
    checkpoint(label + "/written", n_written);
    checkpoint(label + "/made", n_made);
    checkpoint(label + "/largest", largest_value);
    if (checkpoint.reading() && n_written > 0)
      open();
  }

  void SoundStream::finish(const bool at_the_end)
  {
    if (!at_the_end || n_samples == 0)
    {
      write(n_fade);
      file.reset();
      return;
    }
    make_until((n_samples - 1) * step);
    for (std::size_t k = 0; k < waiting.size(); ++k)
      waiting[k] *= fade(waiting.size() - 1 - k);
    write(0);
    file.reset();
    std::error_code error;
    fs::rename(name + ".part", name, error);
    if (error)
      throw OutputError("Cannot rename the file '" + name + ".part': check the folder and its rights.");
  }
} // namespace vibrocontact
