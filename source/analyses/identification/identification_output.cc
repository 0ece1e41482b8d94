#include <vibrocontact/analyses/identification/identification_output.h>
#include <vibrocontact/output/answer_parts.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  using Json = nlohmann::ordered_json;

  FrequencyData fitted_data(const Identification &one, const FrequencyData &data)
  {
    FrequencyData fit = data;
    for (unsigned int i = 0; i < fit.entries.size(); ++i)
      for (unsigned int l = 0; l < fit.frequency.size(); ++l)
        fit.entries[i].values[l] = one.fit.value(i, 2 * M_PI * fit.frequency[l]);
    return fit;
  }

  Table chart_table(const std::vector<ChartPole> &chart)
  {
    Table table({"n_pole_pairs", "frequency_Hz", "damping_ratio", "status"},
                {"Stabilisation chart: poles over their number",
                 "status 0: new; 1: frequency within 1 % of a pole of the order before; 2: damping within 5 "
                 "% as well"});
    for (const ChartPole &pole : chart)
      table.add_row({double(pole.n_pairs), pole.frequency, pole.damping_ratio, double(pole.status)});
    return table;
  }

  Json identification_json(const Identification &one, const FrequencyData &data)
  {
    Json entries = Json::array();
    for (unsigned int i = 0; i < data.entries.size(); ++i)
      entries.push_back(entry_name(data, i));
    Json result = {{"method", one.method},
                   {"n_pole_pairs", one.fit.n_pairs()},
                   {"n_pole_pairs_asked", one.n_asked},
                   {"error_E", one.worst()},
                   {"error_E_of_noise", one.error_of_noise},
                   {"error_E_entries", one.errors},
                   {"entries", entries},
                   {"converged", one.fit.converged},
                   {"target_reached", one.target_reached},
                   {"n_unstable", one.fit.n_unstable()},
                   {"n_states", one.identified.model.n_poles()},
                   {"truncation", one.identified.truncation},
                   {"direct_term_m_N", one.fit.direct},
                   {"seconds", one.seconds}};
    if (one.passivity_looked_at)
      result["passivity"] = {
          {"passive", one.passivity.is_passive() && !one.passivity_refused()},
          {"refused", one.passivity_refused()},
          {"gain_before", one.passivity.gain_before},
          {"gain", one.passivity_refused() ? one.passivity.gain_before : one.passivity.gain},
          {"change", one.passivity.change},
          {"rounds", one.passivity.n_rounds}};
    if (!one.checked)
      return result;
    const WellPosedness &well_posedness = one.well_posedness;
    result["contact"] = {{"usable", well_posedness.usable()},
                         {"repaired", one.repaired},
                         {"repair_failed", one.repair_failed},
                         {"steps_s", well_posedness.steps},
                         {"definiteness", well_posedness.definiteness},
                         {"definiteness_limit", well_posedness.limit},
                         {"initial_value", well_posedness.initial_value},
                         {"impacts", well_posedness.impacts}};
    if (one.repaired)
      result["contact"]["error_E_before_repair"] =
          *std::max_element(one.errors_before_repair.begin(), one.errors_before_repair.end());
    if (!well_posedness.usable())
      result["contact"]["reason"] = well_posedness.reason();
    return result;
  }

  std::vector<std::string> identification_answer(const nlohmann::ordered_json &fits)
  {
    using namespace answer_parts;
    Lines lines;
    const Json *best = largest(fits, "error_E", -1);
    if (!best)
      return lines;
    lines.push_back(text("%s with %.0f pole pairs fits best: E = %.3g (worst entry)%s",
                         word(*best, "method").c_str(), number(*best, "n_pole_pairs"),
                         number(*best, "error_E"),
                         fits.size() > 1 ? text(", of %zu fits", fits.size()).c_str() : ""));
    if (number(*best, "error_E") >= misses_most * number(*best, "error_E_of_noise"))
      lines.push_back("distrust it: it does not follow the data");
    if (best->value("target_reached", true) == false)
      lines.push_back("distrust it: the target error is not reached");
    if (number(*best, "n_unstable") > 0)
      lines.push_back(text("distrust it: %.0f poles are unstable", number(*best, "n_unstable")));
    if (!best->value("converged", true))
      lines.push_back("distrust its last digits: the poles still moved after the last iteration");
    const Json contact = best->value("contact", Json::object());
    if (!contact.empty() && !contact.value("usable", true))
      lines.push_back("not for contact: " + word(contact, "reason"));
    else if (contact.value("repaired", false))
      lines.push_back(
          text("repaired for contact: E was %.3g before", number(contact, "error_E_before_repair")));
    return lines;
  }
} // namespace vibrocontact
