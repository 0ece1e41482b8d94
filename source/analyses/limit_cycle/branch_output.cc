#include <vibrocontact/analyses/limit_cycle/branch_output.h>
#include <vibrocontact/output/answer_parts.h>

#include <algorithm>

namespace vibrocontact
{
  namespace
  {
    using Json = nlohmann::ordered_json;

    const char *name_of(const CycleBranchEnd::Kind kind)
    {
      switch (kind)
      {
      case CycleBranchEnd::Kind::range:
        return "end of the range";
      case CycleBranchEnd::Kind::vanishes:
        return "vanishes";
      default:
        return "lost";
      }
    }

    Json end_json(const CycleBranchEnd &end, const CycleBranchPoint &at)
    {
      Json json = {{"kind", name_of(end.kind)}, {"value", at.value}, {"frequency_Hz", 1 / at.cycle.period}};
      if (end.kind == CycleBranchEnd::Kind::vanishes)
        json["onset"] = end.onset;
      if (!end.reason.empty())
        json["reason"] = end.reason;
      return json;
    }

    /// first the velocities of probes, or the normal force of scenes without
    const Json &main_signal(const Json &point)
    {
      const Json &signals = answer_parts::list(point, "signals");
      const auto heard = std::find_if(signals.begin(), signals.end(),
                                      [](const Json &signal) { return signal.contains("level_dB"); });
      return heard == signals.end() ? signals.at(0) : *heard;
    }

    std::string stability_of(const Json &point)
    {
      return point.contains("stability") ? point["stability"]["verdict"].get<std::string>() : "not judged";
    }
  } // namespace

  Json branch_json(const std::string &entry, const CycleBranch &branch, const std::vector<Json> &points)
  {
    Json json = {{"entry", entry},
                 {"begin", end_json(branch.ends[0], branch.points.front())},
                 {"end", end_json(branch.ends[1], branch.points.back())},
                 {"folds", branch.folds}};
    for (std::size_t k = 0; k + 1 < branch.points.size(); ++k)
      if (branch.points[k].sticks != branch.points[k + 1].sticks)
      {
        const std::size_t last = branch.points[k].sticks ? k : k + 1, other = 2 * k + 1 - last;
        json["first_stick"] = {{"value", branch.points[last].value},
                               {"frequency_Hz", 1 / branch.points[last].cycle.period},
                               {"point", last},
                               {"sticks_above", branch.points[last].value > branch.points[other].value}};
        break;
      }
    json["points"] = points;
    return json;
  }

  Table branch_table(const Json &cycles)
  {
    std::vector<std::string> columns = {"cycle",
                                        "value",
                                        "frequency_Hz",
                                        "stability",
                                        "largest_growth_1_s",
                                        "growth_uncertainty_1_s",
                                        "time_with_stick_share",
                                        "friction_power_W",
                                        "power_into_body_1_W"};
    const auto first = std::find_if(cycles.begin(), cycles.end(),
                                    [](const Json &cycle) { return cycle.contains("branch"); });
    for (const Json &signal : answer_parts::list((*first)["branch"]["points"].at(0), "signals"))
    {
      const std::string name = signal["name"];
      columns.push_back(name + "_amplitude");
      columns.push_back(name + "_first_harmonic");
    }
    columns.insert(columns.end(), {"residual", "newton_iterations", "seconds"});
    Table table(columns, {"Limit cycles followed over " + (*first)["branch"]["entry"].get<std::string>() +
                              ", which is `value`; neighbours in turn, one branch after the other",
                          "cycle: its number in limit_cycle_<number>.csv; growth: of a small disturbance, by "
                          "the Floquet multipliers; empty: stability is not judged"});
    for (const Json &cycle : cycles)
      if (cycle.contains("branch"))
        for (const Json &point : cycle["branch"]["points"])
        {
          const bool is_judged = !answer_parts::list(point, "multipliers").empty();
          std::vector<Table::Cell> row = {cycle["number"].get<double>(), point["value"].get<double>(),
                                          point["frequency_Hz"].get<double>(), stability_of(point)};
          if (is_judged)
          {
            row.push_back(point["multipliers"][0]["growth_1_s"].get<double>());
            row.push_back(point["stability"]["growth_uncertainty_1_s"].get<double>());
          }
          else
            row.insert(row.end(), 2, std::string());
          for (const char *const name : {"time_with_stick_share", "friction_power_W", "power_into_body_1_W"})
            row.push_back(point[name].get<double>());
          for (const Json &signal : answer_parts::list(point, "signals"))
          {
            row.push_back(signal["amplitude"].get<double>());
            row.push_back(signal["first_harmonic"].get<double>());
          }
          for (const char *const name : {"residual", "newton_iterations", "seconds"})
            row.push_back(point[name].get<double>());
          table.add_row(row);
        }
    return table;
  }

  std::string branch_answer(const Json &branch)
  {
    using namespace answer_parts;
    const Json &points = list(branch, "points");
    const auto said_of = [](const Json &point)
    {
      const Json &signal = main_signal(point);
      return text(" (%.2f Hz, ", number(point, "frequency_Hz")) + word(signal, "name") +
             text(" %.3g)", number(signal, "amplitude"));
    };
    const auto say_end = [&](const Json &end, const Json &point)
    {
      std::string said = text("%.6g", number(end, "value")), why = word(end, "kind");
      if (why == "vanishes" && is_given(end, "onset_of_root"))
        said = text("its onset at %.6g", number(end, "onset"));
      else if (why == "vanishes")
        said = text("%.6g, where its amplitude vanishes", number(end, "onset"));
      else if (why == "lost")
        said += ", where it was lost";
      else if (why == "most points")
        said += ", where Limit cycle/Branch/Most points were found";
      if (is_given(end, "onset_of_root"))
        said += text(" (by its root %.6g)", number(end, "onset_of_root"));
      else if (is_given(end, "root_growth_1_s"))
        said += text(" (its root grows by %.3g 1/s there)", number(end, "root_growth_1_s"));
      return said + said_of(point);
    };
    std::string line = "over " + word(branch, "entry") + " from " +
                       say_end(branch.at("begin"), points.at(0)) + "; to " +
                       say_end(branch.at("end"), points.at(points.size() - 1));
    if (branch.contains("first_stick"))
    {
      const Json &stick = branch["first_stick"];
      line += text(stick["sticks_above"].get<bool>() ? "; sticks from %.6g on" : "; sticks up to %.6g",
                   number(stick, "value")) +
              said_of(points.at(stick["point"].get<std::size_t>()));
    }
    const Json &folds = list(branch, "folds");
    for (std::size_t k = 0; k < folds.size(); ++k)
      line += text(k == 0 ? "; turns round at %.6g" : ", %.6g", folds[k].get<double>());
    const std::size_t n_unstable =
        std::count_if(points.begin(), points.end(),
                      [](const Json &point)
                      {
                        const std::string verdict = stability_of(point);
                        return verdict != "stable" && verdict != "neutral" && verdict != "not judged";
                      });
    line += text("; %zu points", points.size());
    if (n_unstable > 0)
      line += text(", %zu of them unstable", n_unstable);
    return line;
  }
} // namespace vibrocontact
