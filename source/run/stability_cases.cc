#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/run/stability_cases.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <sstream>

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

    /// wheel/Material/Young modulus, Pa -> young_modulus_Pa
    std::string column_name(const std::string &entry, const DeclaredParameters &declared)
    {
      const std::size_t slash = entry.rfind('/');
      std::string name = entry.substr(slash + 1);
      std::transform(name.begin(), name.end(), name.begin(),
                     [](const unsigned char c) { return std::isalnum(c) ? std::tolower(c) : '_'; });
      const DeclaredParameters::Entry *const found =
          declared.find(entry.substr(0, slash), entry.substr(slash + 1));
      std::string unit = found ? unit_of(found->documentation) : "";
      std::replace_if(
          unit.begin(), unit.end(), [](const unsigned char c) { return !std::isalnum(c); }, '_');
      return unit.empty() ? name : name + "_" + unit;
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
  } // namespace

  StabilityCases stability_cases(const Parameters &parameters, const ParameterFile &file,
                                 const std::vector<std::string> &overrides)
  {
    StabilityCases result;
    const ParameterSweep &sweep = parameters.stability.sweep;
    if (!parameters.scene.runs("stability") || !sweep.any())
      return result;
    result.left_out = parameters.lateral_positions().left_out;
    result.entries = {sweep.first.entry};
    std::vector<std::string> first = wanted_values(sweep.first, result.left_out), second = {""};
    if (!sweep.second.entry.empty())
    {
      result.entries.push_back(sweep.second.entry);
      second = wanted_values(sweep.second, result.left_out);
    }
    for (unsigned int i = 0; i < first.size(); ++i)
      for (unsigned int j = 0; j < second.size(); ++j)
      {
        StabilityCase one;
        one.first = i;
        one.second = j;
        one.lateral_position = parameters.contact.lateral_position;
        std::vector<std::string> options = overrides;
        std::string text;
        for (unsigned int k = 0; k < result.entries.size(); ++k)
        {
          const std::string &value = k == 0 ? first[i] : second[j];
          one.values.push_back(as_number(value));
          if (result.entries[k] == ParameterSweep::lateral_position)
            one.lateral_position = std::strtod(value.c_str(), nullptr);
          else
            options.push_back(result.entries[k] + "=" + value);
          text += (k == 0 ? "" : ", ") + result.entries[k] + " = " + value;
        }
        dealii::ParameterHandler prm;
        try
        {
          ParameterFile varied(file.file_name(), file.bytes(), options);
          read_parameters(varied, prm, one.parameters, parameters.scene.known_analyses, parameters.tables);
        }
        catch (const InputError &error)
        {
          throw InputError(file.where("Stability/Sweep", "Entry") + ": " + text + ": " + error.what());
        }
        const DeclaredParameters declared = declared_parameters(prm);
        if (result.columns.empty())
          for (const std::string &entry : result.entries)
            result.columns.push_back(column_name(entry, declared));
        for (unsigned int k = 0; k < 2; ++k)
          one.keys.push_back(
              one.parameters.scene.bodies[k].is_meshed() ? reduction_key(one.parameters, declared, k) : "");
        result.cases.push_back(std::move(one));
      }
    return result;
  }

  std::string case_text(const StabilityCases &sweep, const StabilityCase &one)
  {
    std::ostringstream text;
    for (unsigned int k = 0; k < one.values.size(); ++k)
    {
      text << (k == 0 ? "" : ", ") << sweep.columns[k] << " ";
      std::visit([&](const auto &value) { text << value; }, one.values[k]);
    }
    return text.str();
  }
} // namespace vibrocontact
