#pragma once

#include <vibrocontact/numerics/signal.h>

#include <string>

namespace vibrocontact
{
  /// Sampling rate of all sounds [1/s].
  constexpr unsigned int sound_rate = 48000;
  /// Shorter runs have no sound [s].
  constexpr double least_sound = 5e-3;

  /// What the comment of a sound says, and the file `<file_name>.txt` beside it. @param full_scale [m/s] @param begin [s]
  std::string text_of_full_scale(double full_scale, double begin);

  /// Writes a velocity [m/s] as WAV (one channel, 48 kHz, 24 bits; libsndfile): resampled without folding
  /// (resampled()), faded over 2 ms at both ends, its largest value at 0.9 of full scale. Beside it
  /// `<file_name>.txt` says what full scale is. By the calling rank.
  /// @return m/s per full scale; 0: silence, nothing is written
  /// @throws OutputError
  double write_sound(const Signal &velocity, const std::string &file_name);
} // namespace vibrocontact
