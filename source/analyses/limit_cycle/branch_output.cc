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
        const CycleBranchPoint &first = branch.points[branch.points[k].sticks ? k : k + 1];
        json["first_stick"] = {{"value", first.value}, {"frequency_Hz", 1 / first.cycle.period}};
        break;
      }
    json["points"] = points;
    return json;
  }

  Table branch_table(const Json &branch)
  {
    std::vector<std::string> columns = {"value",
                                        "frequency_Hz",
                                        "stability",
                                        "largest_growth_1_s",
                                        "time_with_stick_share",
                                        "friction_power_W",
                                        "power_into_body_1_W"};
    const Json &points = branch.at("points");
    for (const Json &signal : answer_parts::list(points.at(0), "signals"))
    {
      const std::string name = signal["name"];
      columns.push_back(name + "_amplitude");
      columns.push_back(name + "_first_harmonic");
    }
    columns.insert(columns.end(), {"residual", "newton_iterations", "seconds"});
    Table table(columns, {"Limit cycles followed over " + branch.at("entry").get<std::string>() +
                              ", neighbours in turn",
                          "largest growth: of a small disturbance, by the Floquet multipliers; 0 where "
                          "stability is not judged"});
    for (const Json &point : points)
    {
      const Json multipliers = point.value("/stability/multipliers"_json_pointer, Json::array());
      std::vector<Table::Cell> row = {point["value"].get<double>(),
                                      point["frequency_Hz"].get<double>(),
                                      stability_of(point),
                                      multipliers.empty() ? 0. : multipliers[0]["growth_1_s"].get<double>(),
                                      point["time_with_stick_share"].get<double>(),
                                      point["friction_power_W"].get<double>(),
                                      point["power_into_body_1_W"].get<double>()};
      for (const Json &signal : answer_parts::list(point, "signals"))
      {
        row.push_back(signal["amplitude"].get<double>());
        row.push_back(signal["first_harmonic"].get<double>());
      }
      row.push_back(point["residual"].get<double>());
      row.push_back(point["newton_iterations"].get<double>());
      row.push_back(point["seconds"].get<double>());
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
      if (why == "vanishes")
        said = text("its onset at %.6g", number(end, "onset"));
      else if (why == "lost")
        said += ", where it was lost";
      if (is_given(end, "onset_of_root"))
        said += text(" (by its root %.6g)", number(end, "onset_of_root"));
      else if (is_given(end, "root_growth_1_s"))
        said += text(" (where its root grows by %.3g 1/s)", number(end, "root_growth_1_s"));
      return said + said_of(point);
    };
    std::string line = "over " + word(branch, "entry") + " from " +
                       say_end(branch.at("begin"), points.at(0)) + "; to " +
                       say_end(branch.at("end"), points.at(points.size() - 1));
    if (branch.contains("first_stick"))
      for (const Json &point : points)
        if (point["value"] == branch["first_stick"]["value"])
          line += text("; sticks from %.6g on", number(point, "value")) + said_of(point);
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
