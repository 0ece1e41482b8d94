#include <vibrocontact/base/declared_parameters.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/output/atomic_file.h>
#include <vibrocontact/output/run_record.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace vibrocontact
{
  namespace fs = std::filesystem;

  namespace
  {
    const char *list_name = "files.txt";

    void remove_earlier_results(const fs::path &folder)
    {
      std::ifstream list(folder / list_name);
      std::error_code ignored;
      for (std::string name; std::getline(list, name);)
        // Names in the list are relative to the folder and stay inside it.
        if (!name.empty() && name[0] != '/' && name.find("..") == std::string::npos)
          fs::remove(folder / name, ignored);
      fs::remove(folder / "results.json", ignored);
    }
  } // namespace

  std::string begin_run_record(const std::string &folder, const ParameterFile &file,
                               const dealii::ParameterHandler &prm)
  {
    std::string problem;
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      try
      {
        remove_earlier_results(folder);
        write_file(folder + "/input.prm", file.bytes());
        write_file(folder + "/used.prm",
                   print_parameters(declared_parameters(prm), ParameterStyle::values_only));
        run_log().open_file(folder + "/log.txt");
      }
      catch (const InputError &error)
      {
        problem = error.what();
      }
    problem = dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, problem);
    if (!problem.empty())
      throw InputError(problem);
    return folder;
  }

  void end_run_record(const std::string &folder)
  {
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
      return;
    // Only what this run wrote: nothing older than its input.prm.
    const auto begin = fs::last_write_time(fs::path(folder) / "input.prm");
    std::vector<std::string> names;
    for (const auto &entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file() && entry.last_write_time() >= begin)
        names.push_back(fs::relative(entry.path(), folder).string());
    std::sort(names.begin(), names.end());
    std::string text;
    for (const auto &name : names)
      text += name + "\n";
    write_file(folder + "/" + list_name, text);
  }
} // namespace vibrocontact
