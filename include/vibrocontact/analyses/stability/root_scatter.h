#pragma once

#include <nlohmann/json.hpp>

#include <complex>
#include <optional>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// Entries that scatter, normally and independently of each other, and cases drawn from them.
  struct RootScatter
  {
    struct Root
    {
      std::string label;
      /// [1/s]
      std::complex<double> s;
      /// ds/dp of each entry, per SI unit of it; empty: unknown, and the scatter with it
      std::vector<std::complex<double>> derivatives;
      /// in each draw [1/s]; none: it decays and is not found there
      std::vector<std::optional<double>> growth;
    };
    struct Draw
    {
      unsigned int number;
      /// of the entries, SI units
      std::vector<double> values;
    };

    std::vector<std::string> entries;
    std::vector<double> deviations;
    std::vector<Draw> draws;
    std::vector<Root> roots;
  };

  /// To first order growth and frequency deviate by sqrt(sum of (ds/dp_i sigma_i)^2), each part for itself; beside it mean,
  /// deviation and share of growing roots of the draws. Writes stability_scatter.csv and, of draws, stability_draws.csv, and
  /// says it. @return `scatter` of results.json
  nlohmann::ordered_json write_scatter(const RootScatter &scatter, const std::string &folder);
} // namespace vibrocontact
