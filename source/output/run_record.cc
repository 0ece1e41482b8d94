#include <vibrocontact/base/atomic_file.h>
#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/declared_parameters.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/output/run_record.h>

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
    const char *list_name = ".vibrocontact_files";
    /// of the cases of sweeps, all of it a run's own
    const char *sweep_folder = "sweep";
    /// first line of the list: no file of the user's begins like this
    const std::string list_head = "files written by vibrocontact, removed by its next run here";

    std::vector<std::string> listed_files(const fs::path &folder)
    {
      std::vector<std::string> names;
      std::ifstream list(folder / list_name);
      std::string head;
      if (!std::getline(list, head) || head != list_head)
        return names;
      for (std::string name; std::getline(list, name);)
        // Names in the list are relative to the folder and stay inside it.
        if (!name.empty() && name[0] != '/' && name.find("..") == std::string::npos)
          names.push_back(name);
      return names;
    }

    /// Histories grow line by line as .rows and become .h5 when they are whole; checkpoints of the marches in time.
    const std::vector<std::string> row_files = {"histories", "modal_convolution_histories", "signals"},
                                   checkpoint_files = {"checkpoint.h5", "modal_convolution.h5"};

    std::vector<std::string> hdf5_files()
    {
      std::vector<std::string> names = checkpoint_files;
      for (const std::string &name : row_files)
        names.push_back(name + ".h5");
      return names;
    }

    /// What a killed run left half written.
    void remove_parts(const fs::path &folder)
    {
      std::error_code ignored;
      for (const auto &entry : fs::directory_iterator(folder, ignored))
      {
        const std::string file = entry.path().filename().string();
        for (const std::string &name : hdf5_files())
          if (entry.path().extension() == ".part" && file.rfind(name + ".", 0) == 0)
            fs::remove(entry.path(), ignored);
        if (entry.path().extension() == ".part" && file.rfind("results.json.", 0) == 0)
          fs::remove(entry.path(), ignored);
      }
      // sounds that grow go on
      for (const auto &entry : fs::recursive_directory_iterator(folder / sweep_folder, ignored))
        if (entry.path().extension() == ".part" && entry.path().stem().extension() != ".wav")
          fs::remove(entry.path(), ignored);
    }

    /// And the folders above it that are empty then.
    void remove_file(const fs::path &folder, const fs::path &name)
    {
      std::error_code ignored;
      fs::remove(folder / name, ignored);
      for (fs::path place = name.parent_path(); !place.empty(); place = place.parent_path())
        fs::remove(folder / place, ignored);
    }

    /// Sounds that grow: of a run that has not ended, or was killed.
    std::vector<std::string> growing_sounds(const fs::path &folder)
    {
      std::vector<std::string> names;
      std::error_code ignored;
      for (const auto &entry : fs::directory_iterator(folder, ignored))
      {
        const std::string name = entry.path().filename().string();
        for (const std::string ending : {".wav.part", ".wav.part.resumed"})
          if (name.size() > ending.size() &&
              name.compare(name.size() - ending.size(), ending.size(), ending) == 0)
          {
            names.push_back(name);
            names.push_back(name.substr(0, name.size() - ending.size()) + ".wav.txt");
          }
      }
      return names;
    }

    void remove_earlier_results(const fs::path &folder, const bool keeps_input)
    {
      const std::vector<std::string> names = listed_files(folder);
      if (names.empty())
        return;
      std::error_code ignored;
      for (const std::string &name : names)
        if (!(keeps_input && name == "input.prm"))
          remove_file(folder, name);
      // a killed run may have written these after its list
      fs::remove(folder / "results.json", ignored);
      for (const std::string &name : row_files)
        fs::remove(folder / (name + ".rows"), ignored);
      for (const std::string &name : checkpoint_files)
        fs::remove(folder / name, ignored);
      fs::remove_all(folder / sweep_folder, ignored);
      for (const std::string &name : growing_sounds(folder))
        fs::remove(folder / name, ignored);
      remove_parts(folder);
    }
  } // namespace

  RunRecord::RunRecord(const std::string &folder, const ParameterFile &file, const DeclaredParameters &used,
                       const Results *const resumed)
      : folder(folder), resumes(resumed)
  {
    on_first_rank(
        [&]
        {
          try
          {
            // a run of the input.prm in its own folder leaves that file alone
            std::error_code none;
            keeps_input = fs::equivalent(file.file_name(), folder + "/input.prm", none) && !none;
            // a file system may stamp some milliseconds late
            begin = fs::file_time_type::clock::now() - std::chrono::milliseconds(100);
            if (resumes)
            {
              earlier_files = listed_files(folder);
              remove_parts(folder);
            }
            else
              remove_earlier_results(folder, keeps_input);
            if (!keeps_input)
              write_file(folder + "/input.prm", file.bytes());
            write_file(folder + "/used.prm", print_parameters(used, ParameterStyle::values_only));
            write(resumed ? *resumed : Results(), 0.);
          }
          catch (const OutputError &error)
          {
            // nothing is computed yet: another folder is all it takes
            throw InputError(std::string(error.what()) + ", with --output or Output/Directory");
          }
          run_log().open_file(folder + "/log.txt", resumes);
        });
  }

  std::vector<std::string> RunRecord::own_files() const
  {
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
    collect("", {".csv", ".pvd", ".wav"});
    for (const std::string &name : std::vector<std::string>(names))
      if (fs::path(name).extension() == ".wav")
        names.push_back(name + ".txt");
    std::vector<std::string> own = hdf5_files();
    for (const std::string &name : growing_sounds(folder))
      own.push_back(name);
    own.insert(own.end(), {"input.prm", "used.prm", "log.txt", "results.json"});
    for (const std::string &name : row_files)
      own.push_back(name + ".rows");
    for (const std::string &name : own)
      if (!(keeps_input && name == "input.prm") && fs::is_regular_file(fs::path(folder) / name))
        names.push_back(name);
    collect("fields", {".vtu"});
    collect("figures", {".png"});
    collect("contact_problems", {".h5"});
    // folders of a run's own
    std::error_code ignored;
    for (const auto &entry : fs::recursive_directory_iterator(fs::path(folder) / sweep_folder, ignored))
      if (entry.is_regular_file() && entry.last_write_time() >= begin)
        names.push_back(fs::relative(entry.path(), folder).string());
    for (const std::string &name : earlier_files)
      if (fs::is_regular_file(fs::path(folder) / name))
        names.push_back(name);
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
  }

  void RunRecord::write(const Results &results, const double wall_seconds)
  {
    write_file(folder + "/results.json", results_text(results, wall_seconds));
    std::string names = list_head + "\n";
    for (const auto &name : own_files())
      names += name + "\n";
    write_file(folder + "/" + list_name, names);
    last_saved = std::chrono::steady_clock::now();
  }

  void RunRecord::save(const Results &results, const double wall_seconds)
  {
    on_first_rank([&] { write(results, wall_seconds); });
  }

  void RunRecord::save_sometimes(const Results &results, const double wall_seconds)
  {
    on_first_rank(
        [&]
        {
          if (std::chrono::steady_clock::now() - last_saved > std::chrono::seconds(1))
            write(results, wall_seconds);
        });
  }

  void RunRecord::discard() const
  {
    on_first_rank(
        [&]
        {
          run_log().open_file("");
          if (resumes)
            return;
          std::error_code ignored;
          for (const auto &name : own_files())
            remove_file(folder, name);
          fs::remove(fs::path(folder) / list_name, ignored);
        });
  }
} // namespace vibrocontact
