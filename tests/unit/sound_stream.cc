#include "scratch_folder.h"

#include <vibrocontact/base/checkpoint_file.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/hdf5_file.h>
#include <vibrocontact/marching/sound.h>
#include <vibrocontact/marching/sound_stream.h>

#include <deal.II/base/numbers.h>

#include <gtest/gtest.h>
#include <sndfile.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

using namespace vibrocontact;

namespace
{
  constexpr double step = 7e-6, full_scale = 0.5;
  constexpr unsigned int n_steps = 20000;

  double tone(const double frequency, const double time)
  {
    return std::sin(2 * dealii::numbers::PI * frequency * time);
  }

  double velocity(const unsigned int i)
  {
    return 0.2 * tone(917, i * step) + 0.1 * tone(7919, i * step);
  }

  std::vector<double> samples_of(const std::string &file_name)
  {
    SF_INFO info = {};
    SNDFILE *const file = sf_open(file_name.c_str(), SFM_READ, &info);
    if (!file)
      return {};
    std::vector<double> samples(info.frames);
    sf_read_double(file, samples.data(), samples.size());
    sf_close(file);
    return samples;
  }

  /// largest difference of a sound from a velocity beyond 5 ms from both ends, over full scale
  template <typename Velocity>
  double difference(const std::vector<double> &samples, const Velocity &expected)
  {
    double largest = 0;
    for (unsigned int k = 240; k + 240 < samples.size(); ++k)
      largest = std::max(largest, std::abs(samples[k] - expected(double(k) / sound_rate) / full_scale));
    return largest;
  }
} // namespace

TEST(SoundStream, IsTheBandLimitedSignal)
{
  const std::string name = scratch_folder() + "/tone.wav";
  {
    SoundStream stream(name, 0, step, full_scale);
    for (unsigned int i = 0; i < n_steps; ++i)
      stream.add(velocity(i));
    stream.finish(true);
    EXPECT_NEAR(stream.largest(), 0.3, 0.01);
  }
  const std::vector<double> samples = samples_of(name);
  EXPECT_EQ(samples.size(), static_cast<std::size_t>((n_steps - 1) * step * sound_rate) + 1);
  EXPECT_LT(difference(samples, [](const double t) { return 0.2 * tone(917, t) + 0.1 * tone(7919, t); }),
            2e-5);
  EXPECT_FALSE(std::filesystem::exists(name + ".part"));
}

TEST(SoundStream, NothingFoldsBack)
{
  const std::string name = scratch_folder() + "/high.wav";
  SoundStream stream(name, 0, step, full_scale);
  for (unsigned int i = 0; i < n_steps; ++i)
    stream.add(0.2 * tone(31000, i * step)); // would be heard at 17 kHz
  stream.finish(true);
  EXPECT_LT(difference(samples_of(name), [](const double) { return 0.; }), 2e-5);
}

TEST(SoundStream, AgreesWithTheSoundOfTheWholeRun)
{
  Signal whole;
  whole.step = step;
  SoundStream stream(scratch_folder() + "/stream.wav", 0, step, full_scale);
  for (unsigned int i = 0; i < n_steps; ++i)
  {
    whole.values.push_back(velocity(i));
    stream.add(velocity(i));
  }
  stream.finish(true);
  const double scale = write_sound(whole, scratch_folder() + "/whole.wav");
  const std::vector<double> a = samples_of(scratch_folder() + "/stream.wav"),
                            b = samples_of(scratch_folder() + "/whole.wav");
  ASSERT_EQ(a.size(), b.size());
  // fades are of the samples of the run in one, of the sound in the other
  for (unsigned int k = 0; k < a.size(); ++k)
    ASSERT_NEAR(a[k] * full_scale, b[k] * scale, (k < 240 || k + 240 > a.size() ? 2e-2 : 1e-4) * 0.3) << k;
}

TEST(SoundStream, GoesOnFromACheckpoint)
{
  const std::string one = scratch_folder() + "/one.wav", two = scratch_folder() + "/two.wav",
                    file = scratch_folder() + "/checkpoint.h5";
  {
    SoundStream stream(one, 0, step, full_scale);
    for (unsigned int i = 0; i < n_steps; ++i)
      stream.add(velocity(i));
    stream.finish(true);
  }
  {
    SoundStream killed(two, 0, step, full_scale);
    for (unsigned int i = 0; i < n_steps; ++i)
    {
      if (i == 7777)
      {
        Hdf5Writer writer(file);
        CheckpointFile checkpoint(writer);
        killed.exchange("sound", checkpoint);
        writer.finish();
      }
      killed.add(velocity(i));
    }
    // grows while time runs
    EXPECT_GT(samples_of(two + ".part").size(), 2400u);
  }
  {
    SoundStream resumed(two, 0, step, full_scale);
    Hdf5Reader reader(file);
    CheckpointFile checkpoint(reader);
    resumed.exchange("sound", checkpoint);
    // killed now, it can be resumed again
    EXPECT_GT(samples_of(two + ".part").size(), 2400u);
    for (unsigned int i = 7777; i < n_steps; ++i)
      resumed.add(velocity(i));
    resumed.finish(true);
  }
  EXPECT_EQ(samples_of(one), samples_of(two));
  // a run that came to its end goes on later as well
  {
    SoundStream resumed(two, 0, step, full_scale);
    Hdf5Reader reader(file);
    CheckpointFile checkpoint(reader);
    resumed.exchange("sound", checkpoint);
    for (unsigned int i = 7777; i < n_steps; ++i)
      resumed.add(velocity(i));
    resumed.finish(true);
  }
  EXPECT_EQ(samples_of(one), samples_of(two));
  std::filesystem::remove(two);
  SoundStream lost(two, 0, step, full_scale);
  Hdf5Reader reader(file);
  CheckpointFile checkpoint(reader);
  EXPECT_THROW(lost.exchange("sound", checkpoint), InputError);
}
