#include <vibrocontact/analyses/limit_cycle/basins_output.h>
#include <vibrocontact/output/answer_parts.h>

#include <algorithm>

namespace vibrocontact
{
  using namespace answer_parts;

  namespace
  {
    /// of a cycle in a motion, to be worth a word
    constexpr double least_part = 0.02;

    Json between_json(const std::array<unsigned int, 2> &between, const std::vector<CycleOfBasin> &cycles)
    {
      return {cycles[between[0]].number, cycles[between[1]].number};
    }

    double frequency_of(const Json &basins, const Json &number)
    {
      for (const Json &cycle : list(basins, "cycles"))
        if (cycle["number"] == number)
          return cycle["frequency_Hz"];
      return 0;
    }

    /// "327.2 Hz wins up to 0.25 of the way, 907.6 Hz from 0.281 on". @param starts by their share
    std::string winners_text(const Json &basins, const std::vector<const Json *> &starts)
    {
      const auto winner_of = [&](const std::size_t k) { return starts[k]->value("winner", Json(0)); };
      std::string said;
      for (std::size_t begin = 0, end = 0; begin < starts.size(); begin = end)
      {
        while (end < starts.size() && winner_of(end) == winner_of(begin))
          ++end;
        const double low = number(*starts[begin], "share"), high = number(*starts[end - 1], "share");
        said += (said.empty() ? "" : ", ") +
                ((*starts[begin])["decided"].get<bool>()
                     ? text("%.1f Hz wins", frequency_of(basins, winner_of(begin)))
                     : "none wins") +
                (begin + 1 == end ? text(" at %.4g", low) : text(" from %.4g to %.4g", low, high));
      }
      return said + " of the way";
    }

    /// "; divided at 0.25 to 0.281 by a motion with 0.80 of that at 333.6 Hz and 0.31 of that at 917.2 Hz"
    std::string dividing_text(const Json &border, const Json &cycles)
    {
      std::string said;
      const Json &parts = list(border, "dividing_parts");
      for (std::size_t k = 0; k < parts.size(); ++k)
        if (parts[k].get<double>() > least_part)
          said += text(said.empty() ? " by a motion with %.2f of that at %.1f Hz"
                                    : " and %.2f of that at %.1f Hz",
                       parts[k].get<double>(), cycles[k]["frequency_Hz"].get<double>());
      return text("; divided at %.4g to %.4g", number(border, "from"), number(border, "to")) + said;
    }
  } // namespace

  Json path_json(const BasinPath &path, const std::vector<CycleOfBasin> &cycles)
  {
    Json json = {{"between", between_json(path.between, cycles)},
                 {"share", path.share},
                 {"decided", path.winner.has_value()}};
    if (path.winner)
      json["winner"] = cycles[*path.winner].number;
    if (!path.message.empty())
      json["message"] = path.message;
    json["time_s"] = path.time.empty() ? 0 : path.time.back();
    json["parts"] = path.parts.empty() ? std::vector<double>() : path.parts.back();
    json["seconds"] = path.seconds;
    return json;
  }

  Json border_json(const BasinBorder &border, const std::vector<CycleOfBasin> &cycles)
  {
    return {{"between", between_json(border.between, cycles)},
            {"from", border.low},
            {"to", border.high},
            {"winners", between_json(border.winners, cycles)},
            {"dividing_parts", border.dividing}};
  }

  Table starts_table(const Json &basins)
  {
    std::vector<std::string> columns = {"first_cycle", "second_cycle",        "share",
                                        "winner",      "winner_frequency_Hz", "time_s"};
    for (const Json &cycle : list(basins, "cycles"))
      columns.push_back("part_of_cycle_" + std::to_string(cycle["number"].get<int>()));
    columns.insert(columns.end(), {"seconds", "message"});
    Table table(
        columns,
        {"Motions that start on the way from one limit cycle to another, and which cycle they go to",
         "share: of the way; winner: a cycle's number in limit_cycle_<number>.csv, 0: none by the end; "
         "time_s: when it was decided",
         "part_of_cycle: at the end, velocity of its motion over that of the cycle itself"});
    for (const Json &start : list(basins, "starts"))
    {
      const bool decided = start["decided"].get<bool>();
      std::vector<Table::Cell> row = {start["between"][0].get<double>(), start["between"][1].get<double>(),
                                      start["share"].get<double>(),
                                      decided ? start["winner"].get<double>() : 0.};
      if (decided)
        row.emplace_back(frequency_of(basins, start["winner"]));
      else
        row.emplace_back(std::string());
      row.emplace_back(start["time_s"].get<double>());
      for (std::size_t k = 0; k < list(basins, "cycles").size(); ++k)
        if (const Json &parts = list(start, "parts"); k < parts.size())
          row.emplace_back(parts[k].get<double>());
        else
          row.emplace_back(std::string());
      row.emplace_back(start["seconds"].get<double>());
      row.emplace_back(start.value("message", ""));
      table.add_row(row);
    }
    return table;
  }

  Table paths_table(const std::vector<BasinPath> &paths, const std::vector<CycleOfBasin> &cycles)
  {
    std::vector<std::string> columns = {"start", "time_s"};
    for (const CycleOfBasin &cycle : cycles)
      columns.push_back("part_of_cycle_" + std::to_string(cycle.number));
    Table table(columns, {"Motions that start between limit cycles, window by window; start: row of "
                          "limit_cycle_basins.csv, from 1 on; time_s: end of the window",
                          "part_of_cycle: velocity of its motion over that of the cycle itself"});
    for (std::size_t p = 0; p < paths.size(); ++p)
      for (std::size_t w = 0; w < paths[p].time.size(); ++w)
      {
        std::vector<Table::Cell> row = {double(p + 1), paths[p].time[w]};
        row.insert(row.end(), paths[p].parts[w].begin(), paths[p].parts[w].end());
        table.add_row(row);
      }
    return table;
  }

  std::vector<std::string> basins_answer(const Json &basins)
  {
    std::vector<std::string> lines;
    const Json &cycles = list(basins, "cycles");
    for (std::size_t i = 0; i < cycles.size(); ++i)
      for (std::size_t j = i + 1; j < cycles.size(); ++j)
      {
        const Json between = {cycles[i]["number"], cycles[j]["number"]};
        std::vector<const Json *> starts;
        for (const Json &start : list(basins, "starts"))
          if (start["between"] == between)
            starts.push_back(&start);
        std::string line = text("between %.1f and %.1f Hz: ", cycles[i]["frequency_Hz"].get<double>(),
                                cycles[j]["frequency_Hz"].get<double>()) +
                           winners_text(basins, starts);
        for (const Json &border : list(basins, "borders"))
          if (border["between"] == between)
            line += dividing_text(border, cycles);
        lines.push_back(line);
      }
    return lines;
  }
} // namespace vibrocontact
