#include <vibrocontact/base/memory.h>

#include <deal.II/base/mpi.h>

#include <malloc.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <limits>
#include <sstream>

namespace vibrocontact
{
  namespace
  {
    constexpr double unlimited = std::numeric_limits<double>::infinity();

    /// The number behind a name in a file of lines "name number", or the first number for an empty name;
    /// infinite if there is none ("max").
    double number_of(const std::string &file_name, const std::string &name = "")
    {
      std::ifstream file(file_name);
      for (std::string line; std::getline(file, line);)
      {
        std::istringstream words(line);
        std::string word;
        double value = 0;
        if (!name.empty() && (!(words >> word) || word != name))
          continue;
        return words >> value ? value : unlimited;
      }
      return unlimited;
    }

    /// What a group and those above it leave. @param names of the files: limit, use, pages that can be dropped
    void look_at_groups(const std::string &mount, std::string path, const char *const limit,
                        const char *const use, const char *const droppable, MemoryLeft &left)
    {
      while (true)
      {
        const std::string folder = mount + path, file = folder + (path == "/" ? "" : "/") + limit;
        const double most = number_of(file), used = number_of(folder + "/" + use),
                     cached = number_of(folder + "/memory.stat", droppable);
        // version 1 says "no limit" by a number beyond all memory
        if (most < 1e18 && used < unlimited)
        {
          const double bytes = most - used + (cached < used ? cached : 0.);
          if (bytes < left.bytes)
            left = {bytes, "its control group (" + file + ")"};
        }
        if (path.size() <= 1)
          return;
        path = path.substr(0, path.rfind('/'));
        if (path.empty())
          path = "/";
      }
    }
  } // namespace

  MemoryLeft memory_left(const std::string &root)
  {
    MemoryLeft left = {1024 * number_of(root + "/proc/meminfo", "MemAvailable:"), "the machine"};
    std::ifstream groups(root + "/proc/self/cgroup");
    for (std::string line; std::getline(groups, line);)
    {
      // number:controllers:path
      const std::size_t first = line.find(':'), second = line.find(':', first + 1);
      if (first == std::string::npos || second == std::string::npos)
        continue;
      const std::string controllers = line.substr(first + 1, second - first - 1),
                        path = line.substr(second + 1);
      // in a container the path may be that outside: what is mounted is its own group then
      for (const std::string &place : {path, std::string("/")})
        if (controllers.empty())
          look_at_groups(root + "/sys/fs/cgroup", place, "memory.max", "memory.current", "inactive_file",
                         left);
        else if (("," + controllers + ",").find(",memory,") != std::string::npos)
          look_at_groups(root + "/sys/fs/cgroup/memory", place, "memory.limit_in_bytes",
                         "memory.usage_in_bytes", "total_inactive_file", left);
    }
    rlimit space = {};
    if (getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY)
    {
      const double used = 1024 * number_of(root + "/proc/self/status", "VmSize:"),
                   bytes = static_cast<double>(space.rlim_cur) - (used < unlimited ? used : 0.);
      if (bytes < left.bytes)
        left = {bytes, "ulimit -v"};
    }
    left.bytes = std::max(0., left.bytes);
    return left;
  }

  void return_free_memory()
  {
    malloc_trim(0);
  }

  std::string bytes_text(const double bytes)
  {
    char text[40];
    const bool large = bytes >= 1e9;
    const double number = bytes / (large ? 1e9 : 1e6);
    std::snprintf(text, sizeof text, number < 100 ? "%.2g %s" : "%.0f %s", number, large ? "GB" : "MB");
    return text;
  }

  std::string memory_shortage(const std::string &stage, const double bytes, const MPI_Comm communicator)
  {
    namespace MPI = dealii::Utilities::MPI;
    MPI_Comm machine;
    MPI_Comm_split_type(communicator, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
    const double needed = MPI::sum(bytes, machine);
    const MemoryLeft left = memory_left();
    // a limit of the process alone is met by its own share
    const bool own = left.limit == "ulimit -v";
    const unsigned int n_ranks = MPI::n_mpi_processes(machine);
    MPI_Comm_free(&machine);
    const double due = own ? bytes : needed;
    std::string text;
    if (due > left.bytes)
    {
      text = stage + " needs about " + bytes_text(due) +
             (n_ranks > 1 && !own ? " on " + std::to_string(n_ranks) + " ranks" : "") + ", but " +
             left.limit + " leaves " + bytes_text(left.bytes);
    }
    const unsigned int n = MPI::n_mpi_processes(communicator), rank = MPI::this_mpi_process(communicator);
    const unsigned int first = MPI::min(text.empty() ? n : rank, communicator);
    return first == n ? "" : MPI::broadcast(communicator, text, first);
  }
} // namespace vibrocontact
