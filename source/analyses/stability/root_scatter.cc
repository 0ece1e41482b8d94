#include <vibrocontact/analyses/stability/root_scatter.h>
#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/label_text.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/table.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace vibrocontact
{
  namespace
  {
    constexpr double rad_s_per_Hz = 2 * dealii::numbers::PI;

    /// growth of a root in the draws
    struct OfDraws
    {
      unsigned int number = 0;
      double mean = 0, deviation = 0, growing = 0;

      explicit OfDraws(const std::vector<std::optional<double>> &growth)
      {
        unsigned int n_growing = 0;
        for (const auto &one : growth)
          if (one)
          {
            ++number;
            mean += *one;
            n_growing += *one > 0;
          }
        mean /= std::max(1u, number);
        growing = double(n_growing) / std::max(1u, number);
        for (const auto &one : growth)
          if (one)
            deviation += std::pow(*one - mean, 2);
        deviation = std::sqrt(deviation / (number > 1 ? number - 1 : 1));
      }
    };

    Table table_of_draws(const RootScatter &scatter)
    {
      std::vector<std::string> columns = {"draw"};
      columns.insert(columns.end(), scatter.entries.begin(), scatter.entries.end());
      for (const RootScatter::Root &root : scatter.roots)
        columns.push_back("growth_1_s " + label_in_a_table(root.label));
      Table table(columns, {"The draws: values of the entries in SI units, growth of each root"});
      for (unsigned int k = 0; k < scatter.draws.size(); ++k)
      {
        std::vector<Table::Cell> cells = {double(scatter.draws[k].number)};
        cells.insert(cells.end(), scatter.draws[k].values.begin(), scatter.draws[k].values.end());
        for (const RootScatter::Root &root : scatter.roots)
          cells.push_back(root.growth[k] ? Table::Cell(*root.growth[k]) : Table::Cell(std::string()));
        table.add_row(cells);
      }
      return table;
    }
  } // namespace

  nlohmann::ordered_json write_scatter(const RootScatter &scatter, const std::string &folder)
  {
    const bool any_draws = !scatter.draws.empty();
    std::vector<std::string> columns = {"root",
                                        "frequency_Hz",
                                        "growth_1_s",
                                        "frequency_deviation_Hz",
                                        "growth_deviation_1_s",
                                        "probability_of_growth"};
    if (any_draws)
      columns.insert(columns.end(),
                     {"draws", "mean_of_draws_1_s", "deviation_of_draws_1_s", "share_of_growing_draws"});
    Table table(columns,
                {"Scatter of the roots with that of the entries, of first order in it" +
                     std::string(any_draws ? " and by draws;" : ";"),
                 "probability_of_growth: of a normal distribution with the growth and its deviation"});
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const RootScatter::Root &root : scatter.roots)
    {
      if (root.derivatives.empty())
        continue;
      double growth = 0, frequency = 0;
      for (unsigned int i = 0; i < scatter.deviations.size(); ++i)
      {
        growth += std::pow(root.derivatives[i].real() * scatter.deviations[i], 2);
        frequency += std::pow(root.derivatives[i].imag() / rad_s_per_Hz * scatter.deviations[i], 2);
      }
      growth = std::sqrt(growth), frequency = std::sqrt(frequency);
      const double probability = growth > 0 ? 0.5 * std::erfc(-root.s.real() / (growth * std::sqrt(2.)))
                                            : (root.s.real() > 0 ? 1. : 0.);
      std::vector<Table::Cell> cells = {
          root.label, root.s.imag() / rad_s_per_Hz, root.s.real(), frequency, growth, probability};
      json.push_back({{"root", root.label},
                      {"growth_1_s", root.s.real()},
                      {"growth_deviation_1_s", growth},
                      {"probability_of_growth", probability}});
      char line[300];
      std::snprintf(line, sizeof line, "%-20s growth %+.3f 1/s scatters by %.3f 1/s", root.label.c_str(),
                    root.s.real(), growth);
      std::string text = line;
      if (any_draws)
      {
        const OfDraws draws(root.growth);
        if (draws.number < scatter.draws.size())
          run_log().warning(root.label + ", which decays, can be followed in " +
                            std::to_string(draws.number) + " of " + std::to_string(scatter.draws.size()) +
                            " draws; its scatter is that of these.");
        cells.insert(cells.end(), {double(draws.number), draws.mean, draws.deviation, draws.growing});
        json.back()["draws"] = draws.number;
        json.back()["mean_of_draws_1_s"] = draws.mean;
        json.back()["deviation_of_draws_1_s"] = draws.deviation;
        json.back()["share_of_growing_draws"] = draws.growing;
        std::snprintf(line, sizeof line, "; %u draws: mean %+.3f, deviation %.3f, %.1f %% grow", draws.number,
                      draws.mean, draws.deviation, 100 * draws.growing);
        text += line;
      }
      table.add_row(cells);
      run_log().line(text);
    }
    on_first_rank(
        [&]
        {
          table.write(folder + "/stability_scatter.csv");
          if (any_draws)
            table_of_draws(scatter).write(folder + "/stability_draws.csv");
        });
    return json;
  }
} // namespace vibrocontact
