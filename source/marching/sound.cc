#include <vibrocontact/base/atomic_file.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/marching/sound.h>

#include <sndfile.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace vibrocontact
{
  std::string text_of_full_scale(const double full_scale, const double begin)
  {
    std::ostringstream text;
    text.precision(17);
    text << "full scale (1.0) = " << full_scale << " m/s; first sample at " << begin << " s\n";
    return text.str();
  }

  double write_sound(const Signal &velocity, const std::string &file_name)
  {
    Signal sound = resampled(velocity, sound_rate, 2e-3);
    double largest = 0;
    for (const double value : sound.values)
      largest = std::max(largest, std::abs(value));
    if (!(largest > 0))
      return 0;
    const double full_scale = largest / 0.9;
    for (double &value : sound.values)
      value /= full_scale;

    const std::string text = text_of_full_scale(full_scale, sound.begin);
    const std::string part = unique_part(file_name);
    SF_INFO info = {};
    info.samplerate = sound_rate;
    info.channels = 1;
    info.format = SF_FORMAT_WAV | SF_FORMAT_PCM_24;
    SNDFILE *const file = sf_open(part.c_str(), SFM_WRITE, &info);
    bool good = file != nullptr;
    if (file)
    {
      sf_set_string(file, SF_STR_COMMENT, text.c_str());
      good =
          sf_write_double(file, sound.values.data(), sound.size()) == static_cast<sf_count_t>(sound.size());
      good = sf_close(file) == 0 && good;
    }
    std::error_code error;
    if (good)
      std::filesystem::rename(part, file_name, error);
    if (!good || error)
    {
      std::filesystem::remove(part, error);
      throw OutputError("Cannot write the file '" + file_name +
                        "': check the folder and its rights, and the space on the disk.");
    }
    write_file(file_name + ".txt", text);
    return full_scale;
  }
} // namespace vibrocontact
