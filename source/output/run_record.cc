#include <vibrocontact/base/atomic_file.h>
#include <vibrocontact/base/declared_parameters.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/output/run_record.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

namespace vibrocontact
{
  namespace fs = std::filesystem;

  namespace
  {
    const char *list_name = "files.txt";

    bool is_first_rank()
    {
      return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
    }

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

  RunRecord::RunRecord(const std::string &folder, const ParameterFile &file,
                       const dealii::ParameterHandler &prm)
      : folder(folder)
  {
    std::string problem;
    if (is_first_rank())
      try
      {
        for (fs::path path = fs::absolute(folder).lexically_normal(); !fs::exists(path);
             path = path.parent_path())
          first_made = path.string();
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
  }

  std::vector<std::string> RunRecord::own_files() const
  {
    const auto begin = fs::last_write_time(fs::path(folder) / "input.prm");
    std::vector<std::string> names;
    const auto collect = [&](const std::string &place, const std::set<std::string> &endings)
    {
      if (!fs::is_directory(fs::path(folder) / place))
        return;
      for (const auto &entry : fs::directory_iterator(fs::path(folder) / place))
        if (entry.is_regular_file() && entry.last_write_time() >= begin &&
            endings.count(entry.path().extension().string()) > 0)
          names.push_back((fs::path(place) / entry.path().filename()).string());
    };
    // only what a run writes: the folder may hold other things, even other runs
    collect("", {".csv", ".pvd"});
    for (const char *name : {"input.prm", "used.prm", "log.txt", "results.json"})
      if (fs::is_regular_file(fs::path(folder) / name))
        names.push_back(name);
    collect("fields", {".vtu"});
    collect("figures", {".png"});
    collect("contact_problems", {".h5"});
    std::sort(names.begin(), names.end());
    return names;
  }

  void RunRecord::finish() const
  {
    if (!is_first_rank())
      return;
    std::string text;
    for (const auto &name : own_files())
      text += name + "\n";
    write_file(folder + "/" + list_name, text);
  }

  void RunRecord::discard() const
  {
    if (!is_first_rank())
      return;
    run_log().open_file("");
    std::error_code ignored;
    for (const auto &name : own_files())
    {
      fs::remove(folder / fs::path(name), ignored);
      // Folders go when they are empty; fs::remove() leaves others alone.
      fs::remove((folder / fs::path(name)).parent_path(), ignored);
    }
    if (first_made.empty())
      return;
    const fs::path last = fs::path(first_made).parent_path();
    for (fs::path path = fs::absolute(folder).lexically_normal(); path != last && path.has_relative_path();
         path = path.parent_path())
      fs::remove(path, ignored);
  }
} // namespace vibrocontact
