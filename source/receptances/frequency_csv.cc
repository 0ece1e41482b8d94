#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/nearest_names.h>
#include <vibrocontact/receptances/frequency_csv.h>
#include <vibrocontact/receptances/sampled_response.h>

#include <cstdio>

namespace vibrocontact
{
  std::optional<std::string> without_end(const std::string &name, const std::string &end)
  {
    if (name.size() <= end.size() || name.substr(name.size() - end.size()) != end)
      return {};
    return name.substr(0, name.size() - end.size());
  }

  std::vector<std::pair<std::string, std::string>> split_pairs(const CsvTable &table,
                                                               const std::vector<std::string> &pairs)
  {
    std::vector<std::string> known;
    for (const std::string &pair : pairs)
      if (pair.size() % 2 == 1 && pair[pair.size() / 2] == '_' &&
          pair.substr(0, pair.size() / 2) == pair.substr(pair.size() / 2 + 1))
        known.push_back(pair.substr(0, pair.size() / 2));
    std::vector<std::pair<std::string, std::string>> result;
    for (const std::string &pair : pairs)
    {
      const std::size_t before = result.size();
      for (const std::string &response : known)
        for (const std::string &reference : known)
          if (result.size() == before && pair == response + "_" + reference)
            result.emplace_back(response, reference);
      if (result.size() == before)
        throw InputError(
            "The table \"" + table.source + "\" has a column for " + pair +
            ", which is no pair of points that are driven themselves" +
            (known.empty() ? ", of which there are none" : " (" + quoted_list(known, "and") + ")") +
            ": name columns <response>_<force>_real_m_N and add <point>_<point>_real_m_N for "
            "every point.");
    }
    return result;
  }

  namespace
  {
    /// The kinds of columns: end of the name, powers of j omega in them.
    struct Unit
    {
      std::string end;
      unsigned int power;
    };
    const std::vector<Unit> units = {{"_m_N", 0}, {"_m_Ns", 1}, {"_m_Ns2", 2}};

    FrequencyData read_impulse_responses(const CsvTable &table, const std::vector<double> &time)
    {
      check_axis(table.source, time, "s", table.lines);
      const double step = equal_time_step("The table \"" + table.source + "\"", time, 0, table.lines);
      FrequencyData data;
      data.file_name = table.source;
      std::vector<std::string> pairs;
      for (const std::string &name : table.names)
        if (const auto pair = without_end(name, "_m_Ns"))
          pairs.push_back(*pair);
        else if (name != "time_s")
          throw InputError("The table \"" + table.source + "\" has a column " + name +
                           ": an impulse response is called <response>_<force>_m_Ns.");
      const auto points = split_pairs(table, pairs);
      for (unsigned int k = 0; k < pairs.size(); ++k)
      {
        const auto &[response, reference] = points[k];
        FrequencyData::Entry entry;
        entry.response = data.label_index(response);
        entry.reference = data.label_index(reference);
        for (const double value : table.column(pairs[k] + "_m_Ns"))
          entry.values.push_back(value);
        data.entries.push_back(entry);
      }
      transform_to_frequency(data, step);
      return data;
    }
  } // namespace

  FrequencyData read_frequency_csv(const CsvTable &table)
  {
    if (const auto *const time = table.find("time_s"))
      return read_impulse_responses(table, *time);
    FrequencyData data;
    data.file_name = table.source;
    data.frequency = table.column("frequency_Hz");
    check_axis(table.source, data.frequency, "Hz", table.lines);
    std::vector<std::string> pairs;
    std::vector<Unit> unit_of_pair;
    for (const std::string &name : table.names)
    {
      bool understood = name == "frequency_Hz";
      for (const Unit &unit : units)
      {
        if (const auto pair = without_end(name, "_real" + unit.end))
        {
          pairs.push_back(*pair);
          unit_of_pair.push_back(unit);
          understood = true;
        }
        if (const auto pair = without_end(name, "_imag" + unit.end))
        {
          table.column(*pair + "_real" + unit.end);
          understood = true;
        }
      }
      if (!understood)
        throw InputError(
            "The table \"" + table.source + "\" has a column " + name +
            ", which is neither frequency_Hz nor like <response>_<force>_real_m_N (or _imag_; _m_Ns "
            "for mobility, _m_Ns2 for accelerance): rename it or leave it out.");
    }
    const auto points = split_pairs(table, pairs);
    for (unsigned int k = 0; k < pairs.size(); ++k)
    {
      const auto &[response, reference] = points[k];
      FrequencyData::Entry entry;
      entry.response = data.label_index(response);
      entry.reference = data.label_index(reference);
      const std::vector<double> &real = table.column(pairs[k] + "_real" + unit_of_pair[k].end),
                                &imaginary = table.column(pairs[k] + "_imag" + unit_of_pair[k].end);
      for (std::size_t l = 0; l < real.size(); ++l)
        entry.values.emplace_back(real[l], imaginary[l]);
      entry.derivative = unit_of_pair[k].power;
      data.entries.push_back(entry);
    }
    return data;
  }

  std::string frequency_csv(const FrequencyData &data, const std::vector<std::string> &comments)
  {
    std::string text;
    for (const std::string &comment : comments)
      text += "# " + comment + "\n";
    text += "frequency_Hz";
    for (const FrequencyData::Entry &entry : data.entries)
      for (const char *part : {"_real_m_N", "_imag_m_N"})
        text += "," + data.labels[entry.response] + "_" + data.labels[entry.reference] + part;
    text += "\n";
    const auto number = [&](const double value)
    {
      char digits[32];
      std::snprintf(digits, sizeof digits, "%.17g", value);
      text += digits;
    };
    for (std::size_t l = 0; l < data.frequency.size(); ++l)
    {
      number(data.frequency[l]);
      for (const FrequencyData::Entry &entry : data.entries)
      {
        text += ",";
        number(entry.values[l].real());
        text += ",";
        number(entry.values[l].imag());
      }
      text += "\n";
    }
    return text;
  }
} // namespace vibrocontact
