#include <vibrocontact/base/declared_parameters.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/parameter_text.h>
#include <vibrocontact/run/check_entries.h>
#include <vibrocontact/run/run.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <set>
#include <sstream>

using namespace vibrocontact;
namespace fs = std::filesystem;

namespace
{
  const std::string entry_scenes = std::string(TESTS_DIRECTORY) + "/entries";

  std::string file_content(const fs::path &file)
  {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
  }

  /// Entries whose value changes no number of a result, and why: everything else has to change one or be refused.
  const std::map<std::string, std::string> exempt = {
      {"Output/Directory", "where results go"},
      {"Output/Cache directory", "where results go"},
      {"Output/Figures", "drawn of the results"},
      {"Output/Fields", "drawn of the results, where an analysis has fields"},
      {"block/Solver/Method", "the answers are the same to 1e-9 by either"},
      {"upper/Solver/Method", "the answers are the same to 1e-9 by either"},
      {"Contact/Solver/Tolerance", "a solve has to meet it before it counts, and mostly does far better"},
      {"Contact/Solver/Force change", "a solve has to meet it before it counts"},
      {"Contact/Solver/Max Newton iterations", "a solve that needs more is not converged"},
      {"Contact/Solver/Max fixed point iterations", "a solve that needs more is not converged"},
      {"Modal convolution/Contact solver",
       "common asks Contact/Solver, whose automatic Method chooses the active set as well where it may"},
      {"Contact/Friction law", "names the law that the other entries of friction mean already"},
      {"Limit cycle/Max Newton iterations", "a cycle that needs more is not found"},
      {"Transient/Checkpoint interval", "a matter of wall time"},
      {"Modal convolution/Checkpoint interval", "a matter of wall time"},
      {"Contact/Half length",
       "how far contact points are looked for: where there are enough, more change nothing"},
      {"Continuation/Smallest step", "a branch that asks for shorter ones ends and says so"},
      {"Comparison/Repetitions", "times are measured more often"},
      {"Wheel/Write mesh", "a file beside the results"}};

  /// The same for one scene: "scene: entry".
  const std::map<std::string, std::string> exempt_in_scene = {
      {"limit_cycle: Contact/Half width", "a pad on a plane touches all over, the grid ends with its face"},
      {"limit_cycle: Contact/Offset x", "a plane is the same everywhere"},
      {"limit_cycle: Contact/Offset y", "a plane is the same everywhere"}};

  /// The value whose key is what the path ends with; null if there is none.
  template <typename T>
  const T *of_end(const std::map<std::string, T> &table, const std::string &path)
  {
    for (const auto &[end, value] : table)
      if (path == end || (path.size() > end.size() && path[path.size() - end.size() - 1] == '/' &&
                          path.compare(path.size() - end.size(), end.size(), end) == 0))
        return &value;
    return nullptr;
  }

  /// Values to be tried first: of texts, and of numbers that a small change does not move.
  const std::map<std::string, std::vector<std::string>> chosen_values = {
      {"Limit cycle/Multipliers", {"3"}},
      {"Limit cycle/Branch/Range", {"0.69, 0.703"}},
      {"Limit cycle/Branch/Most points", {"2"}},
      {"Limit cycle/Roots", {"5"}},
      {"Limit cycle/Tolerance", {"1e-3"}},
      {"Identification/Iterations", {"1"}},
      {"Identification/Residue tolerance", {"0.1"}},
      {"Periodic/Quadrature points", {"126"}},
      {"History interval", {"1e-5"}},
      {"Signals/Mode amplitudes", {"1", "0"}},
      {"Continuation/Most points", {"3"}},
      {"Continuation/Location tolerance", {"0.1"}},
      {"Title", {"another"}},
      {"Expression", {"2e-7*sin(2*pi*s/0.01)"}},
      {"Speed expression", {"10+t"}},
      {"Points", {"head: 0.2, 0.01, z"}},
      {"Truncated orders", {"4"}},
      {"Numbers of pole pairs", {"5"}},
      {"Contact points", {"5", "tip: 0, 0, 0", "tip: 0, 0, 1"}},
      {"Force point", {"0, 0, 0.2, z", "0, 0, 0.8, z"}},
      {"Rows", {"1e-4:50:40", ""}},
      {"Entry", {"Contact/Friction coefficient"}},
      {"Second entry", {"Contact/Friction coefficient"}},
      {"Values", {"0.1"}},
      {"Second values", {"0.1"}},
      {"Range", {"0.1, 0.2, 0.1"}},
      {"Second range", {"0.1, 0.2, 0.1"}},
      {"Perturbed mode", {"bar:mode 2", "upper:mode 2"}},
      {"Exciting force", {"3*sin(20*t)"}},
      {"Longitudinal creepage", {"0.002", "0.001*t"}},
      {"Lateral creepage", {"0.004, 0.005", "0.004", "0.001*t"}},
      {"Spin", {"0.2", "0.1*t"}},
      {"Normal force", {"20", "20, 30", "20+t"}},
      {"Hub displacement", {"6e-6", "5.5e-6", "6e-6, 7e-6", "6e-6+1e-3*t"}},
      {"Friction coefficient", {"0.25", "0.1, 0.2"}},
      {"Probes", {"end: bar 0 0 10 along z", "end: upper 0 0 0.01 along z"}},
      {"Traction boundary", {"right", "top"}},
      {"Held", {"left", "right"}},
      {"Anechoic lengths", {"0.2"}},
      {"Positions", {"-0.01, 0, 0.01", "0"}},
      {"Method", {"lsce", "vector fitting"}},
      {"Pairs", {"haar:haar", "bspline:fourier"}},
      {"Start value", {"110"}},
      {"Cut frequencies", {"300", "1"}},
      {"Check frequencies", {"250"}},
      {"Frequencies", {"60, 90"}},
      {"Bodies", {}},
      {"Analyses", {}}};

  std::string short_number(const double value)
  {
    std::ostringstream text;
    text.precision(12);
    text << value;
    return text.str();
  }

  /// Other values that an entry may take: the chosen ones, then those of its pattern.
  std::vector<std::string> other_values(const DeclaredParameters::Entry &entry)
  {
    const auto is = [&](const std::string &kind) { return entry.pattern.rfind("[" + kind, 0) == 0; };
    std::vector<std::string> values;
    const auto add = [&](const std::vector<std::string> &more)
    { values.insert(values.end(), more.begin(), more.end()); };
    char *end = nullptr;
    const double value = std::strtod(entry.value.c_str(), &end);
    const std::vector<std::string> *const chosen =
        of_end(chosen_values, joined_path(entry.section, entry.name));
    if (chosen)
      add(*chosen);
    if (is("Selection"))
    {
      std::istringstream stream(entry.pattern.substr(11, entry.pattern.size() - 12));
      for (std::string name; std::getline(stream, name, '|');)
        values.push_back(trimmed(name));
    }
    else if (is("Bool"))
      add({entry.value == "true" ? "false" : "true"});
    else if (is("Integer"))
      add({short_number(value + 1), short_number(value + 2), short_number(std::max(1., value - 1)),
           short_number(2 * value)});
    else if (is("Double") && value == 0)
      add({"1e-3", "0.1", "1", "1e-7", "-1e-3"});
    else if (is("Double"))
      add({short_number(1.1 * value), short_number(0.9 * value), short_number(2 * value),
           short_number(0.5 * value), short_number(-1e-3)});
    else if (!chosen && end != entry.value.c_str())
      // a list: its first number changes
      add({short_number(1.1 * value) + std::string(end), short_number(value + 1) + std::string(end)});
    else if (!chosen)
      add({"1", "0.1"});
    values.erase(std::remove(values.begin(), values.end(), entry.value), values.end());
    return values;
  }

  /// results.json without what the clock says
  void drop_times(nlohmann::json &node)
  {
    if (node.is_object())
    {
      // and what repeats an entry
      std::vector<std::string> times = {"reductions",
                                        "peak_memory_MB",
                                        "program",
                                        "wall_s",
                                        "figures_s",
                                        "stages_s",
                                        "checksum",
                                        "sliding_velocity_m_s",
                                        "sliding_rotation_rad_s",
                                        "friction"};
      for (const auto &[key, child] : node.items())
        if (key.find("seconds") != std::string::npos)
          times.push_back(key);
      for (const std::string &key : times)
        node.erase(key);
    }
    for (auto &child : node)
      if (child.is_structured())
        drop_times(child);
  }

  std::string table_without_times(const std::string &text)
  {
    std::istringstream lines(text);
    std::set<unsigned int> times;
    bool in_table = false;
    std::string result;
    for (std::string line; std::getline(lines, line);)
    {
      if (line.empty() || line[0] == '#')
        continue;
      std::istringstream cells(line);
      unsigned int column = 0;
      for (std::string cell; std::getline(cells, cell, ','); ++column)
      {
        if (!in_table && cell.find("seconds") != std::string::npos)
          times.insert(column);
        if (times.count(column) == 0)
          result += cell + ",";
      }
      result += "\n";
      in_table = true;
    }
    return result;
  }

  /// What a run wrote that does not depend on the clock.
  std::string print_of(const fs::path &folder)
  {
    std::vector<fs::path> files;
    for (const auto &entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file())
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::string print;
    for (const fs::path &file : files)
    {
      const std::string ending = file.extension().string();
      if (ending == ".prm" || ending == ".txt" || file.filename() == ".vibrocontact_files")
        continue;
      print += fs::relative(file, folder).string() + "\n";
      if (file.filename() == "results.json")
      {
        nlohmann::json results = nlohmann::json::parse(file_content(file));
        drop_times(results);
        print += results.dump() + "\n";
      }
      else if (ending == ".csv" || ending == ".vtu")
        print += table_without_times(file_content(file));
    }
    return print;
  }

  struct EntryOutcome
  {
    /// message of wrong input
    std::string refused;
    /// of its results
    std::string print;
  };

  EntryOutcome entry_outcome(const std::string &file, const std::string &folder,
                             const std::vector<std::string> &options)
  {
    CommandLine line;
    line.file = file;
    line.output = folder + "/results";
    line.quiet = true;
    line.overrides = {"Output/Figures=false", "Output/Cache directory=" + folder + "/cache"};
    line.overrides.insert(line.overrides.end(), options.begin(), options.end());
    fs::remove_all(line.output);
    EntryOutcome result;
    try
    {
      const int code = run(standard_tables(), line);
      result.print = std::to_string(code) + "\n" + print_of(line.output);
    }
    catch (const InputError &error)
    {
      result.refused = error.what();
    }
    catch (const ConvergenceError &error)
    {
      result.print = error.what();
    }
    return result;
  }

  std::vector<std::string> scene_names()
  {
    std::vector<std::string> names;
    for (const auto &entry : fs::directory_iterator(entry_scenes))
      if (entry.path().extension() == ".prm")
        names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
  }
} // namespace

class EntriesRead_ : public testing::TestWithParam<std::string>
{
};

TEST_P(EntriesRead_, ChangeTheResultOrAreRefused)
{
  const std::string file = entry_scenes + "/" + GetParam() + ".prm", folder = "entries_" + GetParam();
  fs::remove_all(folder);
  ParameterFile parameter_file(file, file_content(file), {});
  Parameters parameters;
  dealii::ParameterHandler prm;
  const DeclaredParameters declared =
      read_parameters(parameter_file, prm, parameters, standard_tables().analysis_types(),
                      std::make_shared<const EntryTables>());
  const EntryOutcome base = entry_outcome(file, folder, {});
  ASSERT_EQ(base.refused, "");
  ASSERT_TRUE(base.print == entry_outcome(file, folder, {}).print) << "two runs differ";

  unsigned int n_changed = 0, n_unread = 0, n_invalid = 0, n_exempt = 0;
  for (const DeclaredParameters::Entry &entry : declared.entries)
  {
    const std::string path = joined_path(entry.section, entry.name);
    if (entry.section.empty() || entry.name == "Type" || of_end(exempt, path) ||
        exempt_in_scene.count(GetParam() + ": " + path) > 0)
    {
      ++n_exempt;
      continue;
    }
    bool changed = false, unread = false, valid = false;
    for (const std::string &value : other_values(entry))
    {
      const EntryOutcome other = entry_outcome(file, folder, {path + "=" + value});
      unread = other.refused.find(path + " is set, but changes nothing") != std::string::npos;
      valid = valid || other.refused.empty();
      changed = other.refused.empty() && other.print != base.print;
      if (changed || unread)
        break;
    }
    n_changed += changed;
    n_unread += unread;
    n_invalid += !valid && !unread;
    EXPECT_TRUE(changed || unread || !valid) << path << " is accepted but changes nothing";
  }
  std::cout << GetParam() << ": " << n_changed + n_unread + n_invalid << " entries, " << n_changed
            << " change the results, " << n_unread << " are refused as unread, " << n_invalid
            << " as invalid here, " << n_exempt << " exempt\n";
  EXPECT_GT(n_changed, 5u);
  fs::remove_all(folder);
}

INSTANTIATE_TEST_SUITE_P(Scenes, EntriesRead_, testing::ValuesIn(scene_names()),
                         [](const auto &scene) { return scene.param; });

TEST(EntriesRead, EveryAnalysisHasAScene)
{
  std::set<std::string> analyses;
  for (const std::string &scene : scene_names())
  {
    const std::string name = entry_scenes + "/" + scene + ".prm";
    for (const std::string &analysis : ParameterFile(name, file_content(name)).list("Analyses"))
      analyses.insert(analysis);
  }
  for (const AnalysisType &type : standard_tables().analysis_types())
    EXPECT_EQ(analyses.count(type.name), 1u) << type.name;
}
