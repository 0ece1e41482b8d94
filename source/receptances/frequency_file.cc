#include <vibrocontact/base/csv_table.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/receptances/frequency_csv.h>
#include <vibrocontact/receptances/frequency_file.h>
#include <vibrocontact/receptances/uff58.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  namespace
  {
    /// Labels without a sign: displacement and force against an axis count along it.
    void turn_to_axes(FrequencyData &data)
    {
      FrequencyData turned = data;
      turned.labels.clear();
      std::vector<unsigned int> place;
      std::vector<double> sign;
      for (std::string label : data.labels)
      {
        const std::size_t end = label.size() < 3 ? 0 : label.size() - 3;
        const bool against = end > 0 && label.compare(end, 2, "_-") == 0 &&
                             std::string("xyz").find(label.back()) != std::string::npos;
        if (against)
          label.erase(end + 1, 1);
        place.push_back(turned.label_index(label));
        sign.push_back(against ? -1 : 1);
      }
      for (FrequencyData::Entry &entry : turned.entries)
      {
        const double factor = sign[entry.response] * sign[entry.reference];
        for (Complex &value : entry.values)
          value *= factor;
        entry.response = place[entry.response];
        entry.reference = place[entry.reference];
      }
      data = turned;
    }

    /// Leaves out the lines below `lower` and above `upper` (0: none).
    void cut(FrequencyData &data, const double lower, const double upper)
    {
      std::vector<std::size_t> kept;
      for (std::size_t l = 0; l < data.frequency.size(); ++l)
        if (data.frequency[l] >= lower && (upper == 0 || data.frequency[l] <= upper))
          kept.push_back(l);
      if (kept.size() == data.frequency.size())
        return;
      if (kept.size() < 3)
        throw InputError("Identification/Lower frequency = " + number_text(lower) +
                         " Hz and Upper frequency = " + number_text(upper) + " Hz leave " +
                         std::to_string(kept.size()) + " lines of the data \"" + data.file_name +
                         "\", which reach from " + number_text(data.frequency.front()) + " to " +
                         number_text(data.frequency.back()) + " Hz: give a band with at least 3.");
      const auto keep = [&](auto &values)
      {
        auto all = values;
        values.clear();
        for (const std::size_t l : kept)
          values.push_back(all[l]);
      };
      keep(data.frequency);
      for (FrequencyData::Entry &entry : data.entries)
        keep(entry.values);
    }

    void check_reciprocity(FrequencyData &data)
    {
      const unsigned int n = data.labels.size();
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < i; ++j)
        {
          const FrequencyData::Entry *const lower = data.find(i, j), *const upper = data.find(j, i);
          if (!lower || !upper)
            continue;
          double difference = 0, size = 0;
          for (std::size_t l = 0; l < data.frequency.size(); ++l)
          {
            // in the quantity of the file
            const double weight =
                std::pow(data.frequency[l], 2. * std::min(lower->derivative, upper->derivative));
            difference += weight * std::norm(lower->values[l] - upper->values[l]);
            size += weight * (std::norm(lower->values[l]) + std::norm(upper->values[l]));
          }
          const double share = std::sqrt(2 * difference / std::max(size, 1e-300));
          if (share > 0.05)
            throw InputError("The data \"" + data.file_name + "\" are not reciprocal: " + data.labels[i] +
                             " under a force at " + data.labels[j] + " and the reverse differ by " +
                             number_text(100 * share) +
                             " % (rms): set Identification/Rolling data = true if the body turns, otherwise "
                             "mend the measurement or leave one of the two out.");
          for (std::size_t l = 0; l < data.frequency.size(); ++l)
          {
            const Complex mean = (lower->values[l] + upper->values[l]) / 2.;
            const_cast<FrequencyData::Entry *>(lower)->values[l] = mean;
            const_cast<FrequencyData::Entry *>(upper)->values[l] = mean;
          }
        }
    }

    void check_matrix(FrequencyData &data, const bool rolling)
    {
      const unsigned int n = data.labels.size();
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          if (!data.find(i, j) && (rolling || !data.find(j, i)))
            throw InputError("The data \"" + data.file_name + "\" lack the response of " + data.labels[i] +
                             " under a force at " + data.labels[j] +
                             ": contact needs every pair of its points" +
                             (rolling ? ", both ways if the body turns." : "."));
      for (unsigned int a = 0; a < data.entries.size(); ++a)
      {
        const FrequencyData::Entry &entry = data.entries[a];
        if (data.find(entry.response, entry.reference) != &entry)
          throw InputError("The data \"" + data.file_name + "\" hold the response of " +
                           data.labels[entry.response] + " under a force at " + data.labels[entry.reference] +
                           " twice: leave one out.");
        for (std::size_t l = 0; l < entry.values.size(); ++l)
          if (!std::isfinite(entry.values[l].real()) || !std::isfinite(entry.values[l].imag()))
            throw InputError("The data \"" + data.file_name + "\" have no number at " +
                             number_text(data.frequency[l]) + " Hz for " + data.labels[entry.response] +
                             " under a force at " + data.labels[entry.reference] +
                             ": leave that frequency out of all entries or fill it.");
        if (std::all_of(entry.values.begin(), entry.values.end(),
                        [](const Complex &value) { return value == 0.; }))
          throw InputError("The data \"" + data.file_name +
                           "\" are zero at all frequencies for the response of " +
                           data.labels[entry.response] + " under a force at " + data.labels[entry.reference] +
                           ": leave the entry out.");
      }
      if (!rolling)
        check_reciprocity(data);
    }
  } // namespace

  FrequencyData read_frequency_data(const std::string &file_name, const std::string &bytes,
                                    const DataRules &rules)
  {
    const auto ends_with = [&](const std::string &end)
    { return file_name.size() >= end.size() && file_name.substr(file_name.size() - end.size()) == end; };
    FrequencyData data = ends_with(".uff") || ends_with(".unv")
                             ? read_uff58(file_name, bytes)
                             : read_frequency_csv(read_csv(file_name, bytes));
    cut(data, rules.lower, rules.upper);
    turn_to_axes(data);
    for (unsigned int k = 0; k < data.entries.size(); ++k)
      integrate_in_frequency(data, k, data.entries[k].derivative);
    check_matrix(data, rules.rolling);
    for (FrequencyData::Entry &entry : data.entries)
      for (std::size_t l = 0; rules.delay != 0 && l < entry.values.size(); ++l)
        entry.values[l] *= std::polar(1., 2 * M_PI * data.frequency[l] * rules.delay);
    return data;
  }
} // namespace vibrocontact
