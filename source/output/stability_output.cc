#include <vibrocontact/output/stability_output.h>

namespace vibrocontact
{
  namespace
  {
    nlohmann::ordered_json root_json(const StabilityRoot &root)
    {
      return {{"frequency_Hz", root.frequency},
              {"growth_1_s", root.growth},
              {"divergence_rate", root.divergence_rate},
              {"label", root.label},
              {"share", root.share}};
    }
  } // namespace

  Table stability_table(const std::vector<StabilityResult> &results)
  {
    Table table({"case", "friction", "lateral_creepage", "longitudinal_creepage", "spin_1_m",
                 "normal_force_N", "frequency_Hz", "growth_1_s", "divergence_rate", "label", "share"},
                {"Complex eigenvalues about the rolling equilibrium of each case; growth > 0 is unstable",
                 "divergence_rate: real over imaginary part; label: the free mode with the largest share of "
                 "the energy"});
    for (unsigned int k = 0; k < results.size(); ++k)
    {
      const RollingCase &one = results[k].rolling_case;
      for (const StabilityRoot &root : results[k].roots)
        table.add_row({double(k), one.friction, one.creepage.lateral, one.creepage.longitudinal,
                       one.creepage.spin, results[k].normal_force, root.frequency, root.growth,
                       root.divergence_rate, root.label, root.share});
    }
    return table;
  }

  nlohmann::ordered_json stability_json(const std::vector<StabilityResult> &results)
  {
    nlohmann::ordered_json cases = nlohmann::ordered_json::array();
    for (const StabilityResult &result : results)
    {
      nlohmann::ordered_json unstable = nlohmann::ordered_json::array();
      for (const StabilityRoot *const root : result.unstable())
        unstable.push_back(root_json(*root));
      cases.push_back({{"friction", result.rolling_case.friction},
                       {"lateral_creepage", result.rolling_case.creepage.lateral},
                       {"longitudinal_creepage", result.rolling_case.creepage.longitudinal},
                       {"spin_1_m", result.rolling_case.creepage.spin},
                       {"normal_force_N", result.normal_force},
                       {"contact_points", result.contact_points},
                       {"stick_points", result.stick_points},
                       {"unstable", unstable},
                       {"nearest", root_json(result.nearest())},
                       {"seconds", result.seconds}});
    }
    return {{"roots", "stability.csv"}, {"unstable", cases.front()["unstable"]}, {"cases", cases}};
  }
} // namespace vibrocontact
