#include <vibrocontact/receptances/uff58.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  namespace
  {
    std::string formatted(const char *format, const int precision, const double value)
    {
      char text[64];
      std::snprintf(text, sizeof text, format, precision, value);
      return text;
    }

    /// The number in 13 characters with a point: E13.5 if that is exact, else the nearest there is.
    std::string field_13(const double value)
    {
      std::string best = formatted("%.*E", 5, value);
      double distance = std::abs(std::strtod(best.c_str(), nullptr) - value);
      for (const char *format : {"%.*E", "%.*f"})
        for (int precision = 1; precision < 12 && distance > 0; ++precision)
        {
          const std::string text = formatted(format, precision, value);
          const double other = std::abs(std::strtod(text.c_str(), nullptr) - value);
          if (text.size() <= 13 && other < distance)
          {
            best = text;
            distance = other;
          }
        }
      return std::string(13 - best.size(), ' ') + best;
    }

    /// Point and code of the direction of a label such as tread_z.
    std::pair<std::string, int> point_of(const std::string &label)
    {
      const std::size_t at = label.rfind('_');
      if (at == std::string::npos)
        return {label, 0};
      const std::string end = label.substr(at + 1);
      for (const int direction : {1, 2, 3})
        for (const int sign : {1, -1})
          if (end == std::string(sign < 0 ? "-" : "") + "xyz"[direction - 1])
            return {label.substr(0, at), sign * direction};
      return {label, 0};
    }

    template <typename Number>
    void append(std::string &text, const Number value)
    {
      char raw[sizeof value];
      std::memcpy(raw, &value, sizeof value);
      text.append(raw, sizeof value);
    }
  } // namespace

  std::string uff58_text(const FrequencyData &data, const std::string &title, const bool binary)
  {
    const std::vector<double> &axis = data.frequency;
    const std::size_t n = axis.size();
    const double step = (axis.back() - axis.front()) / (n - 1);
    bool even = true;
    for (std::size_t l = 0; l < n; ++l)
      even = even && std::abs(axis[l] - (axis.front() + l * step)) < 1e-9 * step;
    std::vector<std::string> points;
    const auto node_of = [&](const std::string &point)
    {
      const auto found = std::find(points.begin(), points.end(), point);
      if (found == points.end())
        points.push_back(point);
      return (found - points.begin()) + 1;
    };
    for (const std::string &label : data.labels)
      node_of(point_of(label).first);

    std::string text;
    char line[128];
    for (const FrequencyData::Entry &entry : data.entries)
    {
      std::string values;
      for (std::size_t l = 0; l < n; ++l)
      {
        const Complex &value = entry.values[l];
        if (binary)
        {
          if (!even)
            append(values, float(axis[l]));
          append(values, value.real());
          append(values, value.imag());
          continue;
        }
        if (!even)
          values += formatted("%13.*E", 5, axis[l]);
        values += formatted("%20.*E", 12, value.real()) + formatted("%20.*E", 12, value.imag());
        if (!even || l % 2 == 1 || l + 1 == n)
          values += "\n";
      }
      text += "    -1\n";
      std::snprintf(line, sizeof line, binary ? "    58b%6d%6d%12d%12zu%6d%6d%12d%12d\n" : "    58\n", 1, 2,
                    11, values.size(), 0, 0, 0, 0);
      text += line;
      text += title.substr(0, 80) + "\nReceptance, e^{+j omega t}\nNONE\nNONE\nNONE\n";
      const auto [response, response_direction] = point_of(data.labels[entry.response]);
      const auto [reference, reference_direction] = point_of(data.labels[entry.reference]);
      std::snprintf(line, sizeof line, "%5d%10d%5d%10d %-10.10s%10d%4d %-10.10s%10d%4d\n", 4, 0, 0, 0,
                    response.c_str(), int(node_of(response)), response_direction, reference.c_str(),
                    int(node_of(reference)), reference_direction);
      text += line;
      std::snprintf(line, sizeof line, "%10d%10zu%10d", 6, n, int(even));
      text += line + field_13(even ? axis.front() : 0.) + field_13(even ? step : 0.) + field_13(0.) + "\n";
      // specific data types 18 frequency, 8 displacement, 13 excitation force; exponents of length and force
      const auto axis_record =
          [&](const int type, const int length, const int force, const char *name, const char *unit)
      {
        std::snprintf(line, sizeof line, "%10d%5d%5d%5d %-20s %-20s\n", type, length, force, 0, name, unit);
        text += line;
      };
      axis_record(18, 0, 0, "Frequency", "Hz");
      axis_record(8, 1, 0, "Displacement", "m");
      axis_record(13, 0, 1, "Force", "N");
      axis_record(0, 0, 0, "NONE", "NONE");
      text += values + "    -1\n";
    }
    return text;
  }
} // namespace vibrocontact
