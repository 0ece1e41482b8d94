#include <vibrocontact/analyses/stability/stability_output.h>
#include <vibrocontact/output/answer_parts.h>
#include <vibrocontact/run/parameter_sweep.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <set>
#include <tuple>
#include <utility>

namespace vibrocontact
{
  namespace
  {
    nlohmann::ordered_json root_json(const StabilityRoot &root)
    {
      nlohmann::ordered_json result = {{"frequency_Hz", root.frequency},
                                       {"growth_1_s", root.growth},
                                       {"divergence_rate", root.divergence_rate},
                                       {"label", root.label},
                                       {"share", root.share}};
      if (!root.path.empty())
        result["root"] = root.path;
      return result;
    }

    nlohmann::ordered_json values_json(const std::vector<std::string> &columns,
                                       const std::vector<Table::Cell> &values)
    {
      nlohmann::ordered_json result = nlohmann::ordered_json::object();
      for (unsigned int k = 0; k < columns.size(); ++k)
        std::visit([&](const auto &value) { result[columns[k]] = value; }, values[k]);
      return result;
    }

    nlohmann::ordered_json case_json(const StabilityOutcome &outcome, const std::size_t k)
    {
      const StabilityResult &result = outcome.results[k];
      nlohmann::ordered_json unstable = nlohmann::ordered_json::array();
      for (const StabilityRoot *const root : result.unstable())
        unstable.push_back(root_json(*root));
      nlohmann::ordered_json one = {{"friction", result.rolling_case.friction},
                                    {"lateral_creepage", result.rolling_case.creepage.lateral},
                                    {"longitudinal_creepage", result.rolling_case.creepage.longitudinal},
                                    {"spin_1_m", result.rolling_case.creepage.spin},
                                    {"normal_force_N", result.normal_force},
                                    {"hub_displacement_m", result.approach},
                                    {"hub", result.hub},
                                    {"contact_points", result.contact_points},
                                    {"stick_points", result.stick_points},
                                    {"unstable", unstable},
                                    {"nearest", root_json(result.nearest())},
                                    {"seconds", result.seconds}};
      if (std::isfinite(result.modes_reach))
        one["modes_reach_Hz"] = result.modes_reach;
      if (result.n_above > 0)
        one["above_upper_frequency"] = {{"roots", result.n_above}, {"growing", result.n_growing_above}};
      if (result.second_count)
        one["second_count"] = {{"unstable_roots", result.second_count->unstable},
                               {"remainder", result.second_count->remainder},
                               {"evaluations", result.second_count->evaluations},
                               {"seconds", result.second_count->seconds}};
      if (!outcome.columns.empty())
        one["swept"] = values_json(outcome.columns, outcome.values[k]);
      return one;
    }

    std::string unstable_if()
    {
      char text[80];
      std::snprintf(text, sizeof text, "unstable: divergence rate > %g, below is round-off",
                    least_divergence_rate);
      return text;
    }

    bool some_are_exact(const StabilityOutcome &outcome)
    {
      for (const StabilityResult &result : outcome.results)
        for (const StabilityRoot &root : result.roots)
          if (root.exact)
            return true;
      return false;
    }

    /// Those that are unstable somewhere, or nearest to it where nothing is.
    std::set<std::string> paths_that_matter(const StabilityOutcome &outcome)
    {
      std::set<std::string> result;
      for (const StabilityResult &one : outcome.results)
      {
        for (const StabilityRoot *const root : one.unstable())
          result.insert(root->path);
        if (one.unstable().empty())
          result.insert(one.nearest().path);
      }
      return result;
    }

    using Cells = std::vector<Table::Cell>;

    Cells joined(Cells a, const Cells &b)
    {
      a.insert(a.end(), b.begin(), b.end());
      return a;
    }

    std::vector<std::string> joined(std::vector<std::string> a, const std::vector<std::string> &b)
    {
      a.insert(a.end(), b.begin(), b.end());
      return a;
    }
  } // namespace

  Table stability_table(const StabilityOutcome &outcome)
  {
    std::vector<std::string> columns = {
        "case",           "friction",     "lateral_creepage", "longitudinal_creepage", "spin_1_m",
        "normal_force_N", "frequency_Hz", "growth_1_s",       "divergence_rate",       "label",
        "share"};
    std::vector<unsigned int> swept;
    for (unsigned int k = 0; k < outcome.columns.size(); ++k)
      if (std::count(columns.begin(), columns.end(), outcome.columns[k]) == 0)
        swept.push_back(k);
    for (const unsigned int k : swept)
      columns.push_back(outcome.columns[k]);
    if (!outcome.columns.empty())
      columns.push_back("root");
    const bool marked = some_are_exact(outcome);
    if (marked)
      columns.push_back("receptance");
    Table table(
        columns,
        {"Complex eigenvalues about the rolling equilibrium of each case; " + unstable_if(),
         "divergence_rate: real over imaginary part; label: the free mode with the largest share of "
         "the energy" +
             std::string(outcome.columns.empty() ? "" : "; root: the one that its path began as") +
             (marked ? "; receptance: what the root takes of bodies without modes, exact or by poles" : "")});
    for (unsigned int k = 0; k < outcome.results.size(); ++k)
    {
      const StabilityResult &result = outcome.results[k];
      const RollingCase &one = result.rolling_case;
      for (const StabilityRoot &root : result.roots)
      {
        Cells cells = {double(k),
                       one.friction,
                       one.creepage.lateral,
                       one.creepage.longitudinal,
                       one.creepage.spin,
                       result.normal_force,
                       root.frequency,
                       root.growth,
                       root.divergence_rate,
                       root.label,
                       root.share};
        for (const unsigned int s : swept)
          cells.push_back(outcome.values[k][s]);
        if (!outcome.columns.empty())
          cells.push_back(root.path);
        if (marked)
          cells.push_back(root.exact ? "exact" : "poles");
        table.add_row(cells);
      }
    }
    return table;
  }

  Table stability_sweep_table(const StabilityOutcome &outcome)
  {
    const std::set<std::string> wanted = paths_that_matter(outcome);
    Table table(joined(joined({"case"}, outcome.columns),
                       {"root", "frequency_Hz", "growth_1_s", "divergence_rate", "label", "share"}),
                {"Paths of the roots that are unstable in some case of the sweep, or the nearest of a stable "
                 "case; " +
                     unstable_if(),
                 "root: the free mode that the path began as; label: the free mode with the largest share of "
                 "the energy in this case"});
    for (unsigned int k = 0; k < outcome.results.size(); ++k)
      for (const StabilityRoot &root : outcome.results[k].roots)
        if (wanted.count(root.path) > 0)
          table.add_row(
              joined(joined({double(k)}, outcome.values[k]),
                     {root.path, root.frequency, root.growth, root.divergence_rate, root.label, root.share}));
    return table;
  }

  void add_mean_growth(const StabilityOutcome &outcome, nlohmann::ordered_json &json)
  {
    nlohmann::ordered_json result = nlohmann::ordered_json::array();
    std::vector<double> at;
    for (const auto &values : outcome.values)
      if (values.size() == 1 && std::holds_alternative<double>(values[0]))
        at.push_back(std::get<double>(values[0]));
    const std::size_t n = at.size();
    if (n < 2 || n != outcome.results.size() || !outcome.left_out.empty() ||
        std::adjacent_find(at.begin(), at.end(), std::greater_equal<>()) != at.end())
      return;
    for (const std::string &path : paths_that_matter(outcome))
    {
      double sum = 0;
      const StabilityRoot *before = nullptr;
      for (std::size_t k = 0; k < n; ++k)
      {
        const auto &roots = outcome.results[k].roots;
        const auto here = std::find_if(roots.begin(), roots.end(),
                                       [&](const StabilityRoot &root) { return root.path == path; });
        if (here == roots.end())
        {
          before = nullptr;
          break;
        }
        if (before)
          sum += (at[k] - at[k - 1]) * (before->growth + here->growth) / 2;
        before = &*here;
      }
      if (before)
        result.push_back({{"root", path}, {"growth_1_s", sum / (at.back() - at.front())}});
    }
    json["mean_growth"] = result;
  }

  Table stability_map_table(const StabilityOutcome &outcome)
  {
    Table table(
        joined(joined({"case"}, outcome.columns),
               {"normal_force_N", "contact_points", "stick_points", "n_unstable", "unstable", "nearest",
                "frequency_Hz", "growth_1_s", "divergence_rate"}),
        {"What is unstable in each case of the sweep: number and names of the unstable roots; " +
             unstable_if(),
         "nearest: the root with the largest divergence rate (positive: unstable), with frequency and "
         "growth"});
    for (unsigned int k = 0; k < outcome.results.size(); ++k)
    {
      const StabilityResult &result = outcome.results[k];
      std::string names;
      for (const StabilityRoot *const root : result.unstable())
        names += (names.empty() ? "" : " + ") + root->path;
      const StabilityRoot &nearest = result.nearest();
      table.add_row(joined(joined({double(k)}, outcome.values[k]),
                           {result.normal_force, double(result.contact_points), double(result.stick_points),
                            double(result.unstable().size()), names, nearest.path, nearest.frequency,
                            nearest.growth, nearest.divergence_rate}));
    }
    return table;
  }

  nlohmann::ordered_json stability_json(const StabilityOutcome &outcome)
  {
    nlohmann::ordered_json result = {{"roots", "stability.csv"},
                                     {"loss", outcome.loss},
                                     {"least_divergence_rate", least_divergence_rate},
                                     {"unstable", nlohmann::ordered_json::array()},
                                     {"cases", nlohmann::ordered_json::array()}};
    if (!outcome.columns.empty())
    {
      result["sweep"] = "stability_sweep.csv";
      result["map"] = "stability_map.csv";
      result["swept_entries"] = outcome.entries;
      result["swept_columns"] = outcome.columns;
      result["left_out"] = nlohmann::ordered_json::array();
    }
    add_new_cases(outcome, result);
    return result;
  }

  void add_contacts(const StabilityOutcome &outcome, const PlacedContacts &contacts,
                    nlohmann::ordered_json &json)
  {
    for (unsigned int k = 0; k < contacts.all.size(); ++k)
      for (const StabilityResult &result : outcome.results)
        if (!contacts.all[k].name.empty())
        {
          const ContactResultants &one = result.contacts[k];
          json["contacts"][contacts.all[k].name]["cases"].push_back(
              {{"friction", one.friction},
               {"normal_force_N", one.normal_force},
               {"tangential_force_N", {one.tangential_force[0], one.tangential_force[1]}},
               {"contact_points", one.contact_points},
               {"stick_points", one.stick_points}});
        }
  }

  void add_new_cases(const StabilityOutcome &outcome, nlohmann::ordered_json &json)
  {
    for (std::size_t k = json["cases"].size(); k < outcome.results.size(); ++k)
    {
      json["cases"].push_back(case_json(outcome, k));
      if (k == 0)
      {
        json["unstable"] = json["cases"][0]["unstable"];
        json["hub"] = outcome.results[0].hub;
      }
    }
    if (!json.contains("left_out"))
      return;
    for (std::size_t k = json["left_out"].size(); k < outcome.left_out.size(); ++k)
    {
      const auto &[values, reason] = outcome.left_out[k];
      json["left_out"].push_back(values_json(outcome.columns, values));
      json["left_out"].back()["reason"] = reason;
    }
  }

  namespace
  {
    std::string root_text(const nlohmann::ordered_json &root)
    {
      using namespace answer_parts;
      std::string line =
          number(root, "frequency_Hz") > 0
              ? text("%.2f Hz, growth %+.4g 1/s", number(root, "frequency_Hz"), number(root, "growth_1_s"))
              : text("without oscillation, growth %+.4g 1/s", number(root, "growth_1_s"));
      line += ", " + (root.contains("root") ? word(root, "root") : word(root, "label"));
      return line;
    }

    /// " at friction 0.3, lateral_creepage -0.01": the swept values of a case
    std::string case_text(const nlohmann::ordered_json &one)
    {
      using namespace answer_parts;
      Json values = one.value("swept", Json::object());
      if (values.empty())
        for (const char *const name : {"friction", "longitudinal_creepage", "lateral_creepage", "spin_1_m"})
          values[name] = number(one, name);
      std::string line;
      for (const auto &[name, value] : values.items())
        line += (line.empty() ? " at " : ", ") + name + " " +
                (value.is_number() ? text("%g", value.get<double>()) : value.dump());
      return line;
    }

    /// Roots of a case that grow, of those that the modes kept carry or of those beyond, the fastest first.
    std::vector<answer_parts::Json> growing_roots(const answer_parts::Json &one, const bool carried)
    {
      using namespace answer_parts;
      const double reach = one.value("modes_reach_Hz", std::numeric_limits<double>::max());
      std::vector<Json> roots;
      for (const Json &root : list(one, "unstable"))
        if ((number(root, "frequency_Hz") <= reach) == carried)
          roots.push_back(root);
      std::stable_sort(roots.begin(), roots.end(),
                       [](const Json &a, const Json &b)
                       { return number(a, "growth_1_s") > number(b, "growth_1_s"); });
      return roots;
    }

    /// The root that grows first along a sweep of one entry which begins without one, with its case; empty otherwise.
    std::string first_that_grows(const answer_parts::Json &cases)
    {
      using namespace answer_parts;
      for (const Json &one : cases)
      {
        if (one.value("swept", Json::object()).size() != 1)
          return "";
        if (const std::vector<Json> roots = growing_roots(one, true); !roots.empty())
          return &one == &cases.front() ? "" : root_text(roots[0]) + case_text(one);
      }
      return "";
    }

    /// Of all cases: what the modes kept do not carry.
    void say_what_grows_beyond_modes(const answer_parts::Json &cases, answer_parts::Lines &lines)
    {
      std::size_t most = 0;
      double reach = 0;
      for (const answer_parts::Json &one : cases)
        if (const std::size_t n = growing_roots(one, false).size(); n > most)
        {
          most = n;
          reach = answer_parts::number(one, "modes_reach_Hz");
        }
      if (most > 0)
        lines.push_back(
            answer_parts::text("beyond the modes kept, which reach %.6g Hz, %s%zu more %s, not to be trusted",
                               reach, cases.size() > 1 ? "up to " : "", most, most == 1 ? "grows" : "grow"));
    }

    /// Of all cases: what Upper frequency hides.
    void say_what_grows_above(const answer_parts::Json &cases, answer_parts::Lines &lines)
    {
      double most = 0;
      for (const answer_parts::Json &one : cases)
        if (const auto above = one.find("above_upper_frequency"); above != one.end())
          most = std::max(most, answer_parts::number(*above, "growing"));
      if (most > 0)
        lines.push_back(answer_parts::text("above Stability/Upper frequency %s%.0f more grow, not listed",
                                           cases.size() > 1 ? "up to " : "", most));
    }
  } // namespace

  std::vector<std::string> stability_answer(const nlohmann::ordered_json &stability)
  {
    using namespace answer_parts;
    Lines lines;
    const Json &cases = list(stability, "cases");
    if (cases.empty())
      return lines;
    if (cases.size() > 1 || !list(stability, "left_out").empty())
    {
      std::size_t n_unstable = 0;
      Json fastest;
      const Json *fastest_case = nullptr, *nearest = nullptr, *nearest_case = nullptr;
      for (const Json &one : cases)
      {
        const std::vector<Json> roots = growing_roots(one, true);
        n_unstable += !roots.empty();
        if (!roots.empty() &&
            (!fastest_case || number(roots[0], "growth_1_s") > number(fastest, "growth_1_s")))
        {
          fastest = roots[0];
          fastest_case = &one;
        }
        const auto near = one.find("nearest");
        if (near != one.end() &&
            (!nearest || number(*near, "divergence_rate") > number(*nearest, "divergence_rate")))
          std::tie(nearest, nearest_case) = std::make_pair(&*near, &one);
      }
      lines.push_back(text("%zu of %zu cases have roots that grow", n_unstable, cases.size()));
      if (fastest_case)
        lines.push_back("the fastest: " + root_text(fastest) + case_text(*fastest_case));
      else if (nearest)
        lines.push_back("nearest to growing: " + root_text(*nearest) + case_text(*nearest_case));
      if (const std::string first = first_that_grows(cases); !first.empty())
        lines.push_back("the first that grows: " + first);
      const Json *const most = largest(list(stability, "mean_growth"), "growth_1_s", 1);
      if (most && list(stability, "swept_entries") == Json{ParameterSweep::lateral_position})
        lines.push_back("averaged over the positions: " +
                        text("growth %+.4g 1/s, ", number(*most, "growth_1_s")) + word(*most, "root"));
      say_what_grows_beyond_modes(cases, lines);
      say_what_grows_above(cases, lines);
      if (const std::size_t n = list(stability, "left_out").size(); n > 0)
        lines.push_back(std::to_string(n) + (n == 1 ? " case is" : " cases are") +
                        " left out, see left_out in results.json");
      return lines;
    }
    const std::vector<Json> roots = growing_roots(cases[0], true);
    if (roots.empty())
    {
      lines.push_back("nothing grows");
      if (cases[0].contains("nearest"))
        lines.push_back("nearest to growing: " + root_text(cases[0]["nearest"]));
      say_what_grows_beyond_modes(cases, lines);
      say_what_grows_above(cases, lines);
      return lines;
    }
    lines.push_back(text("%zu root%s, the fastest a thousandfold in %.3g s:", roots.size(),
                         roots.size() == 1 ? " grows" : "s grow",
                         std::log(1e3) / number(roots[0], "growth_1_s")));
    for (std::size_t k = 0; k < std::min(roots.size(), most_said); ++k)
      lines.push_back(root_text(roots[k]));
    say_more(roots.size(), "in stability.csv", lines);
    say_what_grows_beyond_modes(cases, lines);
    say_what_grows_above(cases, lines);
    return lines;
  }
} // namespace vibrocontact
