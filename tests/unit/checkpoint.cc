// A checkpoint comes back bit for bit; a damaged one and one of other bodies are refused.

#include "small_march.h"

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/marching/transient_checkpoint.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>

using namespace vibrocontact;

namespace
{
  std::string refusal(const std::string &folder, const ContactPair &pair)
  {
    TransientMarch march = march_of(pair);
    try
    {
      transient_checkpoint(folder).read(march, {});
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "";
  }
} // namespace

TEST(Checkpoint, OfOtherBodiesIsRefused)
{
  const std::string folder = "checkpoint_test";
  std::filesystem::create_directories(folder);
  for (const bool with_mode : {false, true})
  {
    const ContactPair pair = small_pair(with_mode);
    TransientMarch march = march_of(pair);
    march.state.time = 0.1234567;
    march.state.R.reinit(6);
    march.state.R[0] = 1. / 3;
    march.sums.steps = 50;
    const MarchCheckpoint checkpoint = transient_checkpoint(folder);
    checkpoint.write(march, {});

    TransientMarch again = march_of(pair);
    ASSERT_TRUE(checkpoint.read(again, {}));
    EXPECT_EQ(again.state.time, march.state.time);
    EXPECT_EQ(again.state.R[0], march.state.R[0]);
    EXPECT_EQ(again.sums.steps, march.sums.steps);
    // a last step may end by rounding beyond the last time
    EXPECT_NO_THROW(checkpoint.check_end_time(march.state.time - 5e-10, 1e-3));
    EXPECT_THROW(checkpoint.check_end_time(march.state.time - 2e-9, 1e-3), InputError);
    // of another format
    EXPECT_THROW(MarchCheckpoint(folder + "/checkpoint.h5", "Transient", 0).read(again, {}), InputError);

    const auto differs = [&](const std::function<void(ContactPair &)> &change)
    {
      ContactPair other = small_pair(with_mode);
      change(other);
      return refusal(folder, other).find("belongs to other bodies") != std::string::npos;
    };
    EXPECT_FALSE(differs([](ContactPair &p) { p.residual(5, 5) *= 1 + 1e-9; }));
    EXPECT_TRUE(differs([](ContactPair &p) { p.residual(5, 5) *= 1.001; }));
    EXPECT_TRUE(differs([](ContactPair &p) { p.residual(0, 4) *= 1.01; }));
    EXPECT_TRUE(differs([](ContactPair &p) { p.interface.gap[1] *= 1.001; }));
    EXPECT_TRUE(differs([](ContactPair &p) { p.residual.reinit(9, 9); }));
    if (with_mode)
    {
      EXPECT_TRUE(differs([](ContactPair &p) { p.omega[0] += 0.1; }));
      EXPECT_TRUE(differs([](ContactPair &p) { p.damping_ratio[0] *= 1.01; }));
      EXPECT_TRUE(differs([](ContactPair &p) { p.trace(0, 0) *= 1.001; }));
    }
  }
}

TEST(Checkpoint, DamagedIsRefused)
{
  const std::string folder = "damaged_checkpoint_test", name = folder + "/checkpoint.h5";
  std::filesystem::create_directories(folder);
  const ContactPair pair = small_pair(true);
  TransientMarch march = march_of(pair);
  march.state.time = 0.1234567;
  const auto damaged = [&](const std::function<void()> &how)
  {
    transient_checkpoint(folder).write(march, {});
    EXPECT_EQ(refusal(folder, pair), "");
    how();
    return refusal(folder, pair).find("is damaged or incomplete") != std::string::npos;
  };
  // one bit of the time
  EXPECT_TRUE(damaged(
      [&]
      {
        std::fstream stream(name, std::ios::in | std::ios::out | std::ios::binary);
        const std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
        const std::size_t place =
            bytes.find(std::string(reinterpret_cast<const char *>(&march.state.time), 8));
        ASSERT_NE(place, std::string::npos);
        stream.seekp(place + 2);
        stream.put(bytes[place + 2] ^ 0x40);
      }));
  EXPECT_TRUE(damaged([&] { std::filesystem::resize_file(name, std::filesystem::file_size(name) / 2); }));
  EXPECT_TRUE(damaged([&] { std::ofstream(name) << "not HDF5"; }));
}
