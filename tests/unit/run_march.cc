// A signal during a march: where blocks of steps are quick it is answered at the end of one, with a checkpoint there, where they
// take long already within.
#include <vibrocontact/marching/run_march.h>

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

using namespace vibrocontact;

namespace
{
  /// Blocks of 50 steps of a second; in its third step it gets a signal.
  class Signalled : public March
  {
  public:
    explicit Signalled(const std::chrono::milliseconds wall) : wall(wall) {}

    double time() const override { return steps; }
    double end_time() const override { return 1000; }
    bool is_over() override { return steps >= 1000; }
    void advance_block() override { advance_part(50); }
    void advance_part(const unsigned int n_steps) override
    {
      for (unsigned int k = 0; k < n_steps; ++k)
      {
        std::this_thread::sleep_for(wall);
        if (++steps == 3)
          std::raise(SIGTERM);
        if (is_between_blocks())
          return;
      }
    }
    bool is_between_blocks() const override { return steps % 50 == 0; }
    void exchange(CheckpointFile &file) override { file("steps", steps); }
    Marks marks() const override { return {}; }

    int steps = 0;

  private:
    const std::chrono::milliseconds wall;
  };

  int steps_until_the_signal(const std::chrono::milliseconds wall, const std::string &file_name)
  {
    std::filesystem::remove(file_name);
    Signalled march(wall);
    Results results;
    EXPECT_FALSE(run_march("march", march, {file_name, "Transient", 1}, 0, {}, results));
    EXPECT_EQ(results.stopped_by, SIGTERM);
    return march.steps;
  }
} // namespace

TEST(RunMarch, ASignalIsAnsweredBetweenQuickBlocks)
{
  const std::string file_name = "run_march_quick.h5";
  EXPECT_EQ(steps_until_the_signal(std::chrono::milliseconds(0), file_name), 50);
  EXPECT_TRUE(std::filesystem::exists(file_name));
  std::filesystem::remove(file_name);
}

// The block's beginning is that of the march: no checkpoint is needed.
TEST(RunMarch, ASignalIsAnsweredWithinALongBlock)
{
  const std::string file_name = "run_march_long.h5";
  EXPECT_LT(steps_until_the_signal(std::chrono::milliseconds(400), file_name), 50);
  EXPECT_FALSE(std::filesystem::exists(file_name));
}
