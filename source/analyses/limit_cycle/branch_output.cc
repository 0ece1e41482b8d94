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
      case CycleBranchEnd::Kind::most_points:
        return "most points";
      case CycleBranchEnd::Kind::lost:
        return "lost";
      }
      return "";
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
    json["unstable_points"] =
        std::count_if(branch.points.begin(), branch.points.end(),
                      [](const CycleBranchPoint &point)
                      { return point.cycle.stability && point.cycle.stability->is_unstable(); });
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
} // namespace vibrocontact
