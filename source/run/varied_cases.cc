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
    double value_of_entry(const std::string &entry, const DeclaredParameters &declared)
    {
      const std::string where = std::string(section_of_variations) + "/Entries lists " + entry;
      const std::size_t slash = entry.rfind('/');
      const DeclaredParameters::Entry *const found =
          slash == std::string::npos ? nullptr
                                     : declared.find(entry.substr(0, slash), entry.substr(slash + 1));
      if (!found)
        throw InputError(where + ", which is no entry of this file: write it as Section/Entry.");
      char *end = nullptr;
      const double value = std::strtod(found->value.c_str(), &end);
      if (found->value.empty() || *end != 0)
        throw InputError(where + ", whose value is '" + found->value +
                         "', no number: take an entry that has one.");
      return value;
    }

    double step_of_entry(const std::string &entry, const double value)
    {
      constexpr double relative_step = 1e-4, along_tread = 5e-6;
      if (entry == ParameterSweep::lateral_position)
        return along_tread;
      if (value == 0)
        throw InputError(std::string(section_of_variations) + "/Entries lists " + entry +
                         ", which is 0, so that no step of it is small: give it a value.");
      return relative_step * std::abs(value);
    }
  } // namespace

  SweepCases varied_cases(const Parameters &parameters, const ParameterFile &file,
                          const std::vector<std::string> &overrides)
  {
    const DerivativeParameters &asked = parameters.stability.derivatives;
    if (parameters.sweeps.at("stability").any())
      throw InputError(std::string(section_of_variations) +
                       " are those of a single case, but Stability/Sweep sweeps " +
                       parameters.sweeps.at("stability").first.entry + ": empty one of them.");
    SweepCases varied;
    varied.analysis = "stability";
    varied.section = section_of_variations;
    varied.entry = "Entries";
    varied.entries = asked.entries;
    std::vector<double> nominal;
    {
      ParameterFile read(file.file_name(), file.bytes(), overrides);
      Parameters own;
      dealii::ParameterHandler prm;
      read_parameters(read, prm, own, parameters.scene.known_analyses, parameters.tables);
      const DeclaredParameters declared = declared_parameters(prm);
      for (const std::string &entry : asked.entries)
        nominal.push_back(value_of_entry(entry, declared));
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
        values[i] += sign * step_of_entry(asked.entries[i], nominal[i]);
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
