#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/numerics/random_numbers.h>
#include <vibrocontact/run/varied_cases.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace vibrocontact
{
  namespace
  {
    /// Entries that say how finely a body is modelled, whichever section they stand in: what follows from them is no answer to
    /// them, and jumps.
    bool discretises(const DeclaredParameters::Entry &entry)
    {
      for (const char *const name :
           {"Grid spacing", "Half length", "Half width", "Upper frequency", "Section cell size",
            "Contact cell size", "Refinement margin", "Refinement depth", "Contact division",
            "Coarse division", "Growth", "Fine length", "Element length", "Fitted up to"})
        if (entry.name == name)
          return true;
      return entry.pattern.rfind("[Integer", 0) == 0;
    }

    struct VariedEntry
    {
      double value, step;
    };

    /// @param where section and entry that list it, for messages
    VariedEntry varied_entry(const std::string &entry, const DeclaredParameters &declared,
                             const std::string &where)
    {
      constexpr double relative_step = 1e-4, along_tread = 5e-6, from_zero = 5e-7;
      const std::size_t slash = entry.rfind('/');
      const DeclaredParameters::Entry *const found =
          slash == std::string::npos ? nullptr
                                     : declared.find(entry.substr(0, slash), entry.substr(slash + 1));
      if (!found)
        throw InputError(where + entry + ", which is no entry of this file: write it as Section/Entry.");
      if (discretises(*found))
        throw InputError(where + entry +
                         ", which discretises, so that roots have no derivative to it: leave it out.");
      char *end = nullptr;
      const double value = std::strtod(found->value.c_str(), &end);
      if (found->value.empty() || *end != 0)
        throw InputError(where + entry + ", whose value is '" + found->value +
                         "', no number: take an entry that has one.");
      const bool is_length = unit_of(found->documentation) == "m";
      if (entry == ParameterSweep::lateral_position)
        return {value, along_tread};
      if (is_length && value == 0)
        return {value, from_zero};
      if (value == 0)
        throw InputError(where + entry + ", which is 0, so that no step of it is small: give it a value.");
      return {value, relative_step * std::abs(value)};
    }
  } // namespace

  SweepCases varied_cases(const Variations &asked, const Parameters &parameters, const ParameterFile &file,
                          const std::vector<std::string> &overrides)
  {
    SweepCases varied;
    varied.analysis = asked.analysis;
    varied.section = asked.section;
    varied.beside_run = true;
    varied.entry = "Entries";
    varied.entries = asked.entries;
    std::vector<double> nominal, steps;
    {
      ParameterFile read(file.file_name(), file.bytes(), overrides);
      Parameters own;
      dealii::ParameterHandler prm;
      const DeclaredParameters declared =
          read_parameters(read, prm, own, parameters.scene.known_analyses, parameters.tables);
      for (const std::string &entry : asked.entries)
      {
        const VariedEntry one = varied_entry(entry, declared, asked.section + "/Entries lists ");
        nominal.push_back(one.value);
        steps.push_back(one.step);
      }
    }
    const auto add = [&](const std::vector<double> &values)
    {
      std::vector<std::string> options = overrides;
      std::string text;
      for (unsigned int i = 0; i < values.size(); ++i)
      {
        char number[32];
        std::snprintf(number, sizeof number, "%.17g", values[i]);
        if (values[i] != nominal[i])
          options.push_back(asked.entries[i] + "=" + number);
        text += (i == 0 ? "" : ", ") + asked.entries[i] + " = " + number;
      }
      SweepCase one = read_case(varied, parameters, file, options, text);
      one.values.assign(values.begin(), values.end());
      one.first = varied.cases.size();
      one.lateral_position = one.parameters().contact().lateral_position;
      varied.cases.push_back(std::move(one));
    };
    add(nominal);
    for (unsigned int i = 0; i < nominal.size(); ++i)
      for (const double sign : {1., -1.})
      {
        std::vector<double> values = nominal;
        values[i] += sign * steps[i];
        add(values);
      }
    RandomNumbers random(asked.seed);
    for (unsigned int draw = 0; draw < asked.n_draws; ++draw)
    {
      std::vector<double> values = nominal;
      for (unsigned int i = 0; i < values.size(); ++i)
        values[i] += asked.deviations[i] * random.normal();
      add(values);
    }
    return varied;
  }
} // namespace vibrocontact
