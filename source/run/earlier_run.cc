#include <vibrocontact/analyses/modal_convolution/modal_convolution.h>
#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/declared_parameters.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/input_files.h>
#include <vibrocontact/base/parameter_text.h>
#include <vibrocontact/marching/transient_checkpoint.h>
#include <vibrocontact/run/earlier_run.h>
#include <vibrocontact/run/sweep_cases.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

namespace vibrocontact
{
  namespace
  {
    std::string content(const std::string &folder, const std::string &name)
    {
      std::ifstream file(folder + "/" + name, std::ios::binary);
      std::ostringstream text;
      text << file.rdbuf();
      if (!file || text.str().empty())
        throw InputError("--resume finds no run in the folder \"" + folder + "\", it has no " + name +
                         ", hence no checkpoint either: give the folder of the interrupted run by --output, "
                         "or run the file without --resume");
      return text.str();
    }

    /// Of a march: that of the run, and those of a sweep's cases unless it sweeps `End time`.
    std::vector<std::string> folders_of_march(const std::string &folder, const Parameters &parameters,
                                              const std::string &analysis, const std::string &section)
    {
      std::vector<std::string> folders = {folder};
      const auto sweep = parameters.sweeps.find(analysis);
      if (sweep == parameters.sweeps.end() || !sweep->second.any() ||
          sweep->second.sweeps(section + "/End time"))
        return folders;
      std::error_code none;
      for (const auto &one :
           std::filesystem::directory_iterator(folder + "/sweep/" + results_key(analysis), none))
        if (one.is_directory())
          folders.push_back(one.path().string());
      return folders;
    }

    bool may_change(const std::string &section, const std::string &name)
    {
      return section == "Output" || ((section == "Transient" || section == "Modal convolution") &&
                                     (name == "End time" || name == "Checkpoint interval"));
    }

    void check_same(const std::string &folder, const std::string &earlier, const DeclaredParameters &used)
    {
      const ParameterText before = scan_parameter_text(folder + "/used.prm", earlier),
                          now = scan_parameter_text("", print_parameters(used, ParameterStyle::values_only));
      const auto compare = [&](const ParameterText &a, const ParameterText &b, const bool a_is_before)
      {
        for (const auto &entry : a.entries)
        {
          const auto *const other = b.find(entry.section, entry.name);
          if (may_change(entry.section, entry.name) || (other && other->value == entry.value))
            continue;
          const auto quoted = [](const ParameterText::Entry *const e)
          { return e ? "\"" + e->value + "\"" : std::string("absent"); };
          throw InputError(
              joined_path(entry.section, entry.name) + " is " + quoted(a_is_before ? other : &entry) +
              ", but was " + quoted(a_is_before ? &entry : other) + " in the run in \"" + folder +
              "\": --resume goes on with the same parameters, only End time and Checkpoint interval of "
              "Transient or Modal convolution and section Output may change");
        }
      };
      compare(before, now, true);
      compare(now, before, false);
    }

    void check_files(const std::string &folder, const std::map<std::string, std::string> &before,
                     const DeclaredParameters &used)
    {
      for (const auto &[entry, now] : input_files(used))
      {
        // what lies ahead of a transient is read from tables as they are now
        const auto found = before.find(entry);
        if (entry.rfind("Transient/", 0) != 0 && found != before.end() && found->second != now)
          throw InputError(entry + " names a file that has changed since the run in \"" + folder + "\" (" +
                           found->second + " then, " + (now.empty() ? "absent" : now) +
                           " now): --resume goes on with the same input; bring the file back, or run without "
                           "--resume");
      }
    }
  } // namespace

  void check_earlier_run(const std::string &folder)
  {
    on_all_ranks([&] { content(folder, "used.prm"); });
  }

  Results earlier_results(const std::string &folder, const DeclaredParameters &used,
                          const Parameters &parameters)
  {
    const ModalConvolutionParameters &road = parameters.modal_convolution;
    Results results;
    on_all_ranks(
        [&]
        {
          check_same(folder, content(folder, "used.prm"), used);
          for (const std::string &one : folders_of_march(folder, parameters, "transient", "Transient"))
            transient_checkpoint(one).check_end_time(parameters.transient.end_time,
                                                     parameters.transient.least_step());
          for (const std::string &one :
               folders_of_march(folder, parameters, "modal convolution", "Modal convolution"))
            road_checkpoint(one).check_end_time(road.end_time, road.time_step);
          results = results_of_text(content(folder, "results.json"));
          check_files(folder, results.input_files, used);
        });
    return results;
  }
} // namespace vibrocontact
