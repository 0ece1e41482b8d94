// What a machine and its control groups leave is read as they write it; the cost of a reduction grows with its size.
#include <vibrocontact/base/memory.h>
#include <vibrocontact/reduction/reduction_cost.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

using namespace vibrocontact;

namespace
{
  void write(const std::string &name, const std::string &text)
  {
    const std::filesystem::path path("memory_test" + name);
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << text;
  }
} // namespace

TEST(Memory, TheTightestOfMachineAndControlGroupsCounts)
{
  std::filesystem::remove_all("memory_test");
  write("/proc/meminfo", "MemTotal:       24684092 kB\nMemFree:  1 kB\nMemAvailable:   8000000 kB\n");
  EXPECT_DOUBLE_EQ(memory_left("memory_test").bytes, 8000000. * 1024);
  EXPECT_EQ(memory_left("memory_test").limit, "the machine");

  // version 2: a group below one with a limit of its own; pages of files can be dropped
  write("/proc/self/cgroup", "0::/box/job\n");
  write("/sys/fs/cgroup/box/memory.max", "5000000000\n");
  write("/sys/fs/cgroup/box/memory.current", "3000000000\n");
  write("/sys/fs/cgroup/box/memory.stat", "anon 1\ninactive_file 500000000\n");
  write("/sys/fs/cgroup/box/job/memory.max", "max\n");
  write("/sys/fs/cgroup/box/job/memory.current", "3000000000\n");
  EXPECT_DOUBLE_EQ(memory_left("memory_test").bytes, 2.5e9);
  EXPECT_NE(memory_left("memory_test").limit.find("/sys/fs/cgroup/box/memory.max"), std::string::npos);
  write("/sys/fs/cgroup/box/job/memory.max", "3100000000\n");
  EXPECT_DOUBLE_EQ(memory_left("memory_test").bytes, 1e8);

  // version 1, in a container that sees another path than its own
  write("/proc/self/cgroup", "4:cpu,memory:/outside/42\n0::/\n");
  write("/sys/fs/cgroup/memory/memory.limit_in_bytes", "2000000000\n");
  write("/sys/fs/cgroup/memory/memory.usage_in_bytes", "1500000000\n");
  write("/sys/fs/cgroup/memory/memory.stat", "total_inactive_file 0\n");
  EXPECT_DOUBLE_EQ(memory_left("memory_test").bytes, 5e8);
  write("/sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
  EXPECT_EQ(memory_left("memory_test").limit, "the machine");
  std::filesystem::remove_all("memory_test");
}

TEST(MemoryMpi, AShortageIsOneSentenceOnEveryRank)
{
  EXPECT_EQ(memory_shortage("Nothing", 0., MPI_COMM_WORLD), "");
  const std::string text = memory_shortage("The factorisation", 1e18, MPI_COMM_WORLD);
  EXPECT_NE(text.find("The factorisation needs about "), std::string::npos) << text;
  EXPECT_NE(text.find("leaves"), std::string::npos) << text;
}

TEST(ReductionCost, OfTheMainJobIsThatMeasured)
{
  // wheel, then rail, whose peak meets what the wheel keeps: 8.3 GB measured on two ranks
  const ReductionCost wheel = reduction_cost({287175, 0.65, 1800, 101, true}),
                      rail = reduction_cost({199785, 0.4, 1800, 237, true});
  EXPECT_NEAR(std::max(wheel.peak, wheel.kept + rail.peak), 8.3e9, 0.15 * 8.3e9);
  EXPECT_LT(reduction_cost({10000, 1, 300, 0, false}).peak, 2e8);
  EXPECT_GT(wheel.peak, wheel.stages[1].bytes);
}
