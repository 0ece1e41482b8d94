#include <vibrocontact/analyses/frequency_response/frequency_response_output.h>
#include <vibrocontact/output/answer_parts.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace vibrocontact
{
  namespace
  {
    using Json = nlohmann::ordered_json;

    std::string label(const ResponsePoint &point)
    {
      return point.name + "_" + "zxy"[point.component];
    }

    /// calls action(label of response, label of force, index into a Receptance) for every pair, one of (i, j) and (j, i) if
    /// they are equal
    void
    for_each_pair(const FrequencyResponseParameters &parameters, const ResponseVariant &variant,
                  const std::function<void(const std::string &, const std::string &, unsigned int)> &action)
    {
      const std::vector<ResponsePoint> points = parameters.parsed_points();
      for (unsigned int i = 0; i < points.size(); ++i)
        for (unsigned int j = variant.is_reciprocal ? i : 0; j < points.size(); ++j)
          action(label(points[i]), label(points[j]), i * points.size() + j);
    }

    /// what differences of an entry are compared with: the entry at driving points, the geometric mean of
    /// both driving points at transfers, which may vanish by symmetry
    double scale(const Receptance &response, const unsigned int index)
    {
      const unsigned int n = std::lround(std::sqrt(double(response.size())));
      return std::sqrt(std::abs(response[index / n * (n + 1)]) * std::abs(response[index % n * (n + 1)]));
    }

    std::vector<std::string> pair_columns(const FrequencyResponseParameters &parameters,
                                          const ResponseVariant &variant)
    {
      std::vector<std::string> columns;
      for_each_pair(parameters, variant,
                    [&](const std::string &response, const std::string &force, unsigned int)
                    {
                      for (const char *part : {"_real", "_imag"})
                        columns.push_back(response + "_" + force + part + parameters.unit_ending());
                    });
      return columns;
    }

    void add_pairs(std::vector<Table::Cell> &row, const FrequencyResponseParameters &parameters,
                   const ResponseVariant &variant, const unsigned int k)
    {
      for_each_pair(parameters, variant,
                    [&](const std::string &, const std::string &, const unsigned int index)
                    {
                      const auto value = parameters.shown(variant.response[k][index], variant.frequency[k]);
                      row.push_back(value.real());
                      row.push_back(value.imag());
                    });
    }

    std::vector<std::string> comments(const FrequencyResponseParameters &parameters,
                                      const ResponseVariant &variant, const std::string &what)
    {
      return {what,
              parameters.quantity +
                  " of the first point under a unit force e^{i w t} at the second, directions x, y, z of "
                  "the contact frame; " +
                  (variant.is_reciprocal ? "symmetric in the points"
                                         : "not symmetric in the points, since the body turns")};
    }
  } // namespace

  Table response_table(const FrequencyResponseParameters &parameters, const ResponseVariant &variant,
                       const std::string &body)
  {
    std::vector<std::string> columns = pair_columns(parameters, variant);
    columns.insert(columns.begin(), "frequency_Hz");
    Table table(columns, comments(parameters, variant,
                                  "Frequency response of " + body + ", method " + variant.method));
    for (unsigned int k = 0; k < variant.frequency.size(); ++k)
    {
      std::vector<Table::Cell> row = {variant.frequency[k]};
      add_pairs(row, parameters, variant, k);
      table.add_row(row);
    }
    return table;
  }

  Table check_table(const FrequencyResponseParameters &parameters,
                    const std::vector<ResponseVariant> &variants, const std::string &body)
  {
    std::vector<std::string> columns = pair_columns(parameters, variants.front());
    columns.insert(columns.begin(), {"frequency_Hz", "method", "modes"});
    Table table(columns, comments(parameters, variants.front(),
                                  "Frequency response of " + body + " by several methods"));
    for (unsigned int k = 0; k < variants.front().frequency.size(); ++k)
      for (const ResponseVariant &variant : variants)
      {
        std::vector<Table::Cell> row = {variant.frequency[k], variant.method, double(variant.n_modes)};
        add_pairs(row, parameters, variant, k);
        table.add_row(row);
      }
    return table;
  }

  Json checks_json(const FrequencyResponseParameters &parameters,
                   const std::vector<ResponseVariant> &variants)
  {
    Json result = Json::array();
    const ResponseVariant &exact = variants.front();
    for (unsigned int v = 1; v < variants.size(); ++v)
      for (unsigned int k = 0; k < exact.frequency.size(); ++k)
        for_each_pair(parameters, exact,
                      [&](const std::string &response, const std::string &force, const unsigned int index)
                      {
                        const auto right = exact.response[k][index], got = variants[v].response[k][index];
                        const double whole = scale(exact.response[k], index);
                        Json entry = {{"frequency_Hz", exact.frequency[k]},
                                      {"response", response},
                                      {"force", force},
                                      {"method", variants[v].method},
                                      {"n_modes", variants[v].n_modes},
                                      {"error", std::abs(got - right) / whole}};
                        if (std::abs(right.imag()) > 1e-3 * whole)
                          entry["error_imaginary_receptance"] = got.imag() / right.imag() - 1;
                        result.push_back(entry);
                      });
    return result;
  }

  Json difference_json(const FrequencyResponseParameters &parameters, const ResponseVariant &exact,
                       const ResponseVariant &other)
  {
    Json result = Json::array();
    for_each_pair(parameters, exact,
                  [&](const std::string &response, const std::string &force, const unsigned int index)
                  {
                    std::vector<double> differences;
                    for (unsigned int k = 0; k < exact.frequency.size(); ++k)
                      differences.push_back(std::abs(other.response[k][index] - exact.response[k][index]) /
                                            scale(exact.response[k], index));
                    const auto largest = std::max_element(differences.begin(), differences.end());
                    const double frequency = exact.frequency[largest - differences.begin()], value = *largest;
                    std::sort(differences.begin(), differences.end());
                    result.push_back({{"response", response},
                                      {"force", force},
                                      {"largest", value},
                                      {"frequency_Hz", frequency},
                                      {"median", differences[differences.size() / 2]}});
                  });
    return result;
  }

  void for_each_driving_point(const FrequencyResponseParameters &parameters,
                              const std::function<void(const std::string &, unsigned int)> &action)
  {
    const std::vector<ResponsePoint> points = parameters.parsed_points();
    for (unsigned int i = 0; i < points.size(); ++i)
      action(label(points[i]), i * (points.size() + 1));
  }

  std::vector<std::string> frequency_response_answer(const nlohmann::ordered_json &response)
  {
    using namespace answer_parts;
    Lines lines;
    const bool mobility = word(response, "quantity") == "mobility";
    const std::string quantity = mobility ? "mobility" : "receptance", unit = mobility ? "m/(N s)" : "m/N";
    const Json bodies = response.value("bodies", Json::object());
    for (const auto &[name, body] : bodies.items())
    {
      const Json &maxima = list(body, "maxima"), &minima = list(body, "minima");
      Lines said;
      if (const Json *const peak = largest(maxima, "magnitude", 1))
        said.push_back(text("largest %s %.4g %s at %.6g Hz (%s)", quantity.c_str(),
                            number(*peak, "magnitude"), unit.c_str(), number(*peak, "frequency_Hz"),
                            word(*peak, "point").c_str()));
      if (const Json *const dip = largest(minima, "magnitude", -1))
        said.push_back(text("smallest minimum %.4g %s at %.6g Hz", number(*dip, "magnitude"), unit.c_str(),
                            number(*dip, "frequency_Hz")));
      if (maxima.size() + minima.size() > 2)
        said.push_back(text("%zu maxima and %zu minima in all", maxima.size(), minima.size()));
      std::string whole = name;
      for (const std::string &part : said)
        whole += (&part == &said.front() ? ": " : "; ") + part;
      if (!said.empty())
        lines.push_back(whole);
      if (is_given(body, "n_poles"))
        lines.push_back(text("%s: Green's functions of %.0f poles", name.c_str(), number(body, "n_poles")));
      double worst = 0;
      for (const Json &one : list(body, "checks"))
        worst = std::max(worst, number(one, "error"));
      if (!list(body, "checks").empty())
        lines.push_back(
            text("%s: modes are up to %.2g %% off the direct solutions, see checks in results.json",
                 name.c_str(), 100 * worst));
    }
    return lines;
  }
} // namespace vibrocontact
