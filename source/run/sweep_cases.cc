#include <vibrocontact/base/checksum.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/input_files.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/run/sweep_cases.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <sstream>
#include <utility>

namespace vibrocontact
{
  namespace
  {
    std::variant<double, std::string> as_number(const std::string &text)
    {
      char *end = nullptr;
      const double value = std::strtod(text.c_str(), &end);
      if (!text.empty() && *end == 0)
        return value;
      return text;
    }

    /// wheel/Material/Young modulus, Pa -> young_modulus_Pa; of several entries of one axis that of the first
    /// @param path whether the sections stand in it as well
    std::string column_name(const std::string &axis, const DeclaredParameters &declared, const bool path)
    {
      const std::string entry = moved_entries({axis}).front();
      const std::size_t slash = entry.rfind('/');
      const std::string name = results_key(path ? entry : entry.substr(slash + 1));
      const DeclaredParameters::Entry *const found =
          declared.find(entry.substr(0, slash), entry.substr(slash + 1));
      std::string unit = found ? unit_of(found->documentation) : "";
      std::replace_if(
          unit.begin(), unit.end(), [](const unsigned char c) { return !std::isalnum(c); }, '_');
      return unit.empty() ? name : name + "_" + unit;
    }

    std::vector<std::string> column_names(const std::vector<std::string> &entries,
                                          const DeclaredParameters &declared)
    {
      std::vector<std::string> columns;
      for (const bool path : {false, true})
      {
        columns.clear();
        for (const std::string &entry : entries)
          columns.push_back(column_name(entry, declared, path));
        const bool is_alone = columns.size() == 1 || columns.front() != columns.back();
        // what tables of roots have as well
        if (is_alone && std::count(columns.begin(), columns.end(), "frequency_Hz") == 0)
          break;
      }
      return columns;
    }

    std::vector<std::string> wanted_values(const ParameterSweep::Axis &axis,
                                           const std::vector<double> &left_out)
    {
      std::vector<std::string> values = axis.values();
      if (axis.entry == ParameterSweep::lateral_position)
        values.erase(std::remove_if(values.begin(), values.end(),
                                    [&](const std::string &text) {
                                      return std::count(left_out.begin(), left_out.end(),
                                                        std::strtod(text.c_str(), nullptr)) > 0;
                                    }),
                     values.end());
      return values;
    }

    /// What tells a reduction apart.
    std::string reduction_text(const unsigned int k, const std::string &key, const ModeParameters &modes)
    {
      return std::to_string(k) + "\n" + key + "\n" + modes.key();
    }

    unsigned long long mark_of(DeclaredParameters declared)
    {
      declared.entries.erase(std::remove_if(declared.entries.begin(), declared.entries.end(),
                                            [](const DeclaredParameters::Entry &entry)
                                            { return entry.section == "Output"; }),
                             declared.entries.end());
      const std::string text = print_parameters(declared, ParameterStyle::values_only);
      Checksum sum;
      sum.add(text.data(), text.size());
      for (const auto &[entry, content] : input_files(declared))
        sum.add(content.data(), content.size());
      return sum.value();
    }

    unsigned long long mark_at(const unsigned long long mark, const double lateral_position)
    {
      Checksum sum;
      sum.add(&mark, sizeof mark);
      sum.add(&lateral_position, sizeof lateral_position);
      return sum.value();
    }

  } // namespace

  SweepCase read_case(SweepCases &sweep, const Parameters &parameters, const ParameterFile &file,
                      const std::vector<std::string> &options, const std::string &text)
  {
    SweepCase one;
    dealii::ParameterHandler prm;
    const auto read = std::make_shared<Parameters>();
    DeclaredParameters declared;
    try
    {
      ParameterFile varied(file.file_name(), file.bytes(), options);
      declared = read_parameters(varied, prm, *read, parameters.scene.known_analyses, parameters.tables);
    }
    catch (const InputError &error)
    {
      throw InputError(file.where(sweep.section, sweep.entry) + ": " + text + ": " + error.what());
    }
    one.read = read;
    one.mark = mark_of(declared);
    if (sweep.columns.empty())
      sweep.columns = column_names(sweep.entries, declared);
    for (unsigned int k = 0; k < read->scene.bodies.size(); ++k)
    {
      const BodyParameters &body = read->scene.bodies[k];
      one.keys.push_back(body.is_meshed() || body.is_periodic_rail() ? reduction_key(*read, declared, k)
                                                                     : "");
    }
    return one;
  }

  namespace
  {
    SweepCases cases_of(const AnalysisType &type, const Parameters &parameters, const ParameterFile &file,
                        const std::vector<std::string> &overrides)
    {
      const ParameterSweep &asked = parameters.sweeps.at(type.name);
      SweepCases sweep;
      sweep.analysis = type.name;
      sweep.section = type.sweep_section + "/Sweep";
      const bool on_a_band = type.sweeps_band && asked.sweeps(ParameterSweep::lateral_position);
      if (on_a_band)
        sweep.left_out = parameters.lateral_positions().left_out;
      sweep.entries = {asked.first.entry};
      std::vector<std::string> first = wanted_values(asked.first, sweep.left_out), second = {""};
      if (!asked.second.entry.empty())
      {
        sweep.entries.push_back(asked.second.entry);
        second = wanted_values(asked.second, sweep.left_out);
      }
      std::map<std::vector<std::string>, SweepCase> known;
      Progress progress("reading the cases of " + sweep.section, double(first.size()) * second.size());
      for (unsigned int i = 0; i < first.size(); ++i)
        for (unsigned int j = 0; j < second.size(); ++j)
        {
          std::vector<std::variant<double, std::string>> values;
          double lateral_position = parameters.contact().lateral_position;
          std::vector<std::string> options = overrides;
          std::string text;
          for (unsigned int k = 0; k < sweep.entries.size(); ++k)
          {
            const std::string &value = k == 0 ? first[i] : second[j];
            values.push_back(as_number(value));
            if (on_a_band && sweep.entries[k] == ParameterSweep::lateral_position)
            {
              lateral_position = std::strtod(value.c_str(), nullptr);
              const double nominal = parameters.position_on_grid(lateral_position);
              if (nominal != parameters.contact().lateral_position)
              {
                char number[32];
                std::snprintf(number, sizeof number, "%.12g", nominal);
                options.push_back(std::string(ParameterSweep::lateral_position) + "=" + number);
              }
            }
            else
              for (const std::string &entry : moved_entries({sweep.entries[k]}))
                options.push_back(entry + "=" + value);
            text += (k == 0 ? "" : ", ") + sweep.entries[k] + " = " + value;
          }
          auto there = known.find(options);
          if (there == known.end())
            there = known.emplace(options, read_case(sweep, parameters, file, options, text)).first;
          SweepCase one = there->second;
          one.values = std::move(values);
          one.first = i;
          one.second = j;
          one.lateral_position = lateral_position;
          one.mark = mark_at(one.mark, lateral_position);
          sweep.cases.push_back(std::move(one));
          progress.advance();
        }
      return sweep;
    }
  } // namespace

  std::vector<SweepCases> sweep_cases(const Parameters &parameters, const ParameterFile &file,
                                      const std::vector<std::string> &overrides)
  {
    std::vector<SweepCases> result;
    for (const AnalysisType &type : parameters.scene.known_analyses)
      if (parameters.scene.runs(type.name) && !type.sweep_section.empty() &&
          parameters.sweeps.at(type.name).any())
        result.push_back(cases_of(type, parameters, file, overrides));
    return result;
  }

  std::string results_key(const std::string &name)
  {
    std::string key = name;
    std::transform(key.begin(), key.end(), key.begin(),
                   [](const unsigned char c) { return std::isalnum(c) ? std::tolower(c) : '_'; });
    return key;
  }

  std::string case_text(const SweepCases &sweep, const SweepCase &one)
  {
    std::ostringstream text;
    for (unsigned int k = 0; k < one.values.size(); ++k)
    {
      text << (k == 0 ? "" : ", ") << sweep.columns[k] << " ";
      std::visit([&](const auto &value) { text << value; }, one.values[k]);
    }
    return text.str();
  }

  std::vector<MeshedBodies> bodies_of_cases(const SweepCases &sweep, const MeshedBodies &of_the_file)
  {
    std::map<std::string, std::shared_ptr<MeshedBody>> known;
    for (unsigned int k = 0; k < of_the_file.size(); ++k)
      if (of_the_file[k])
      {
        const ReductionRequest &own = of_the_file[k]->reduction.request();
        known[reduction_text(k, own.key, own.modes)] = of_the_file[k];
      }
    // poles are fitted to what the key stands for
    const auto track_text = [](const std::string &key, const BodyParameters &body)
    { return key + "\npole pairs " + std::to_string(body.description->periodic_rail()->n_pole_pairs); };
    std::map<std::string, std::shared_ptr<TrackBody>> known_tracks;
    for (const auto &track : of_the_file.tracks)
      if (track)
        known_tracks[track_text(track->key(), track->parameters)] = track;
    std::vector<MeshedBodies> result;
    for (const SweepCase &one : sweep.cases)
    {
      result.emplace_back();
      for (unsigned int k = 0; k < one.keys.size(); ++k)
      {
        std::shared_ptr<MeshedBody> body;
        std::shared_ptr<TrackBody> track;
        if (one.parameters().scene.bodies[k].is_periodic_rail())
        {
          std::shared_ptr<TrackBody> &there =
              known_tracks[track_text(one.keys[k], one.parameters().scene.bodies[k])];
          if (!there)
            there = track_body(one.parameters(), one.keys[k], k);
          track = there;
        }
        else if (!one.keys[k].empty())
        {
          const ModeParameters &modes = one.parameters().modes.at(one.parameters().scene.bodies[k].name);
          std::shared_ptr<MeshedBody> &there = known[reduction_text(k, one.keys[k], modes)];
          if (!there)
            there = meshed_body(one.parameters(), one.keys[k], k);
          body = there;
        }
        result.back().push_back(body);
        result.back().tracks.push_back(track);
      }
    }
    return result;
  }
} // namespace vibrocontact
