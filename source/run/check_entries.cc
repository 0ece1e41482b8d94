#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/nearest_names.h>
#include <vibrocontact/base/parameter_text.h>
#include <vibrocontact/run/check_entries.h>

#include <algorithm>
#include <cstdlib>
#include <map>

namespace vibrocontact
{
  namespace
  {
    /// An entry that the file or an option gives.
    struct Given
    {
      std::string section, name;
      /// `file.prm:12` or `--set "Contact/Friction coefficient"`
      std::string location;
      bool by_option = false;
      /// the file's own value, whatever options say; null if it gives none
      const std::string *own_value = nullptr;
    };

    /// The file's in its order, then those of options alone.
    std::vector<Given> all_given(const ParameterFile &file, const ParameterText &text,
                                 const std::vector<std::string> &overrides)
    {
      std::vector<Given> result;
      const std::string option = "--set ";
      for (const ParameterText::Entry &entry : text.entries)
      {
        // the entry itself, an option in its place, or neither: an option's alternative has replaced it
        const std::string where = file.where(entry.section, entry.name),
                          line = file.file_name() + ":" + std::to_string(entry.line);
        const bool by_option = where.rfind(option, 0) == 0;
        if (by_option || where.rfind(line, 0) == 0)
          result.push_back({entry.section, entry.name, by_option ? where : line, by_option, &entry.value});
      }
      for (const std::string &one : overrides)
      {
        const std::string path = trimmed(one.substr(0, one.find('=')));
        const std::size_t slash = path.rfind('/');
        const std::string section = slash == std::string::npos ? "" : trimmed(path.substr(0, slash)),
                          name = slash == std::string::npos ? path : trimmed(path.substr(slash + 1));
        if (std::none_of(result.begin(), result.end(),
                         [&](const Given &known) { return known.section == section && known.name == name; }))
          result.push_back({section, name, file.where(section, name), true, nullptr});
      }
      return result;
    }

    std::string path_of(const Given &given)
    {
      return joined_path(given.section, given.name);
    }

    /// As texts or as numbers.
    bool same_value(const std::string &a, const std::string &b)
    {
      const std::string one = trimmed(a), other = trimmed(b);
      if (one == other)
        return true;
      char *end = nullptr, *other_end = nullptr;
      const double value = std::strtod(one.c_str(), &end),
                   other_value = std::strtod(other.c_str(), &other_end);
      return !one.empty() && !other.empty() && *end == 0 && *other_end == 0 && value == other_value;
    }

    bool is_set(const Given &given, const DeclaredParameters::Entry &entry)
    {
      const bool is_default = same_value(entry.value, entry.default_value);
      if (!given.by_option || !is_default)
        return !is_default;
      // an option that takes back what the file sets
      return given.own_value == nullptr || same_value(*given.own_value, entry.default_value);
    }

    /// The listed analyses.
    class Readers
    {
    public:
      Readers(const std::vector<Analysis> &analyses, const Parameters &parameters)
      {
        for (const std::string &analysis : parameters.scene.analyses)
          entries.push_back(entries_read(analyses, analysis, parameters));
      }

      bool read(const std::string &path) const
      {
        return std::any_of(entries.begin(), entries.end(),
                           [&](const EntriesRead &one) { return one.contains(path); });
      }

    private:
      std::vector<EntriesRead> entries;
    };

    /// What the file reads by itself; nothing if it is not complete without the options.
    class ReadersOfTheFile
    {
    public:
      ReadersOfTheFile(const ParameterFile &file, const std::vector<Analysis> &analyses,
                       const Parameters &with_options)
          : alone(file.file_name(), file.bytes()), analyses(analyses), with_options(with_options)
      {
      }

      bool read(const std::string &path)
      {
        if (!looked)
        {
          looked = true;
          try
          {
            Parameters parameters;
            dealii::ParameterHandler prm;
            parameters.take(with_options.tables);
            parameters.read_lists(alone, prm, with_options.scene.known_analyses);
            alone.parse(prm);
            readers.emplace_back(analyses, parameters);
          }
          catch (const InputError &)
          {
          }
        }
        return !readers.empty() && readers.front().read(path);
      }

    private:
      const ParameterFile alone;
      const std::vector<Analysis> &analyses;
      const Parameters &with_options;
      bool looked = false;
      std::vector<Readers> readers;
    };

    /// Who would read an entry, and when.
    std::string who_reads(const std::string &path, const std::vector<Analysis> &analyses,
                          const Parameters &parameters)
    {
      std::vector<std::string> others;
      std::string conditions;
      for (const AnalysisType &type : parameters.scene.known_analyses)
      {
        if (type.n_bodies > parameters.scene.bodies.size())
          continue;
        const EntriesRead entries = entries_read(analyses, type.name, parameters);
        if (entries.contains(path))
          others.push_back(type.name);
        else if (parameters.scene.runs(type.name) && !entries.condition(path).empty())
          conditions += "\"" + type.name + "\" reads it where " + entries.condition(path) + "; ";
      }
      if (!others.empty())
        return conditions + quoted_list(others, "and") + " would read it";
      return conditions.empty() ? "no analysis reads it with the other entries as they are"
                                : conditions.substr(0, conditions.size() - 2);
    }

    struct Twins
    {
      std::string first, second, meaning;
    };

    /// Entries of two sections that mean the same.
    const std::vector<Twins> &twins()
    {
      static const std::vector<Twins> table = {
          {"Rolling/Speed", "Road/Speed", "the speed"},
          {"Rolling/Hub displacement", "Road/Indentation", "how far the bodies are pressed together"},
          {"Transient/Roughness/Expression", "Road/Expression", "the height of the road"},
          {"Transient/Roughness/Table", "Road/Table", "the height of the road"},
          {"Transient/Roughness/Expression", "Road/Table", "the height of the road"},
          {"Transient/Roughness/Table", "Road/Expression", "the height of the road"}};
      return table;
    }
  } // namespace

  std::vector<std::string>
  entries_out_of_use(const ParameterFile &file, const std::vector<std::string> &overrides,
                     const std::vector<Analysis> &analyses, const Parameters &parameters,
                     const DeclaredParameters &declared, const std::vector<SweepCases> &sweeps)
  {
    std::map<std::string, Given> set;
    std::map<std::string, std::string> values;
    std::vector<std::string> order;
    const ParameterText text = scan_parameter_text(file.file_name(), file.bytes());
    for (const Given &given : all_given(file, text, overrides))
    {
      const DeclaredParameters::Entry &entry = *declared.find(given.section, given.name);
      if (!is_set(given, entry))
        continue;
      set[path_of(given)] = given;
      values[path_of(given)] = entry.value;
      order.push_back(path_of(given));
    }
    std::map<std::string, std::string> twin;
    for (const Twins &pair : twins())
      if (set.count(pair.first) > 0 && set.count(pair.second) > 0)
      {
        if (!same_value(values[pair.first], values[pair.second]))
          throw InputError(set[pair.first].location + ": " + pair.first + " is " + values[pair.first] +
                           " and " + pair.second + " is " + values[pair.second] + ", but both say " +
                           pair.meaning + ": make them equal or leave one of them out.");
        twin[pair.first] = pair.second;
        twin[pair.second] = pair.first;
      }

    const Readers readers(analyses, parameters);
    const auto is_read_in_a_case = [&](const SweepCases &sweep, const std::string &path)
    {
      return std::any_of(sweep.cases.begin(), sweep.cases.end(),
                         [&](const SweepCase &one)
                         { return Readers(analyses, one.parameters()).read(path); });
    };
    const auto is_read = [&](const std::string &path)
    {
      return readers.read(path) ||
             std::any_of(sweeps.begin(), sweeps.end(),
                         [&](const SweepCases &sweep) { return is_read_in_a_case(sweep, path); });
    };
    for (const SweepCases &sweep : sweeps)
      for (const std::string &entry : moved_entries(sweep.entries))
        if (!is_read(entry))
          throw InputError(file.where(sweep.section, sweep.entry) + ": " + entry +
                           (sweep.beside_run ? " is varied" : " is swept") +
                           ", but it changes nothing: " + who_reads(entry, analyses, parameters) +
                           (sweep.beside_run ? ". Name another entry." : ". Sweep another entry."));
    ReadersOfTheFile readers_of_the_file(file, analyses, parameters);
    std::vector<std::string> out_of_use, refused;
    for (const std::string &path : order)
      if (!is_read(path) && !(twin.count(path) > 0 && is_read(twin[path])))
        (!set[path].by_option && readers_of_the_file.read(path) ? out_of_use : refused).push_back(path);
    if (refused.empty())
      return out_of_use;
    std::string others;
    for (unsigned int k = 1; k < refused.size() && k <= 5; ++k)
      others += (k == 1 ? " The same holds for " : ", ") + refused[k];
    if (refused.size() > 6)
      others += " and " + std::to_string(refused.size() - 6) + " more";
    throw InputError(set[refused[0]].location + ": " + refused[0] + " is set, but changes nothing of " +
                     quoted_list(parameters.scene.analyses, "and") + ": " +
                     who_reads(refused[0], analyses, parameters) + ". Leave it out." + others +
                     (others.empty() ? "" : "."));
  }

  void check_reach_of_sweeps(const std::vector<Analysis> &analyses, const Parameters &parameters)
  {
    const auto check = [&](const std::string &sweep, const std::string &what, const std::string &single,
                           const std::vector<std::string> &followers)
    {
      for (const std::string &analysis : parameters.scene.analyses)
        if (std::count(followers.begin(), followers.end(), analysis) == 0 &&
            entries_read(analyses, analysis, parameters).contains(single))
          throw InputError(sweep + " sweeps " + what + ", but the analysis \"" + analysis +
                           "\" does not follow it and would run at one value: run it from a file without the "
                           "sweep.");
    };
    for (const std::string &entry : parameters.rolling.sweep.given())
    {
      const std::string name = entry.substr(entry.rfind('/') + 1);
      check(entry, "quasi-static rolling and stability",
            (name == "Friction coefficient" ? parameters.contact().section + "/" : "Rolling/") + name,
            {"quasi-static rolling", "stability"});
    }
    for (const Analysis &analysis : analyses)
    {
      const std::string &name = analysis.type.name;
      if (!parameters.scene.runs(name) || analysis.type.sweep_section.empty())
        continue;
      const ParameterSweep &sweep = parameters.sweeps.at(name);
      for (const ParameterSweep::Axis *const axis : {&sweep.first, &sweep.second})
      {
        if (axis->entry.empty())
          continue;
        std::vector<std::string> followers;
        for (const auto &[other, own] : parameters.sweeps)
          if (own.sweeps(axis->entry))
            followers.push_back(other);
        for (const std::string &moved : moved_entries({axis->entry}))
          check(analysis.type.sweep_section + "/Sweep", moved + " in " + name + " alone", moved, followers);
      }
    }
  }
} // namespace vibrocontact
