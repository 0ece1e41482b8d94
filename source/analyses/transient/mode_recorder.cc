#include <vibrocontact/analyses/transient/mode_recorder.h>
#include <vibrocontact/base/label_text.h>
#include <vibrocontact/base/table.h>
#include <vibrocontact/numerics/amplitude_growth.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace vibrocontact
{
  namespace
  {
    constexpr std::size_t most_lines = 2048;

    std::string column_of_mode(const std::size_t k)
    {
      return "mode_" + std::to_string(k);
    }
  } // namespace

  ModeRecorder::ModeRecorder(ModeProjection projection, std::string folder)
      : projection(std::move(projection)), folder(std::move(folder))
  {
  }

  void ModeRecorder::add(const DynamicState &state)
  {
    if (steps++ % every != 0)
      return;
    const std::vector<double> now = projection.amplitudes(state);
    times.push_back(state.time);
    values.insert(values.end(), now.begin(), now.end());
    if (times.size() <= most_lines)
      return;
    const std::size_t n = now.size();
    std::size_t kept = 0;
    for (std::size_t line = 0; line < times.size(); line += 2, ++kept)
    {
      times[kept] = times[line];
      std::copy_n(values.begin() + line * n, n, values.begin() + kept * n);
    }
    times.resize(kept);
    values.resize(kept * n);
    every *= 2;
  }

  void ModeRecorder::exchange(CheckpointFile &file)
  {
    file("mode_amplitudes/every", every);
    file("mode_amplitudes/steps", steps);
    file("mode_amplitudes/times", times);
    file("mode_amplitudes/values", values);
  }

  void ModeRecorder::finish(bool)
  {
    const std::vector<StabilityRoot> &roots = projection.roots();
    std::vector<std::string>
        columns = {"time_s"},
        comments = {"Velocity amplitudes of the modes of the linearised contact, largest in the contact: "
                    "the state projected on the left eigenvectors at the equilibrium"};
    for (std::size_t k = 0; k < roots.size(); ++k)
    {
      char line[200];
      std::snprintf(line, sizeof line, "%s: %s, %.6g Hz, growth of the root %.6g 1/s",
                    column_of_mode(k).c_str(), label_in_a_table(roots[k].label).c_str(), roots[k].frequency,
                    roots[k].growth);
      comments.push_back(line);
      columns.push_back(column_of_mode(k) + "_m_s");
    }
    Table table(columns, comments);
    for (std::size_t line = 0; line < times.size(); ++line)
    {
      std::vector<Table::Cell> row = {times[line]};
      for (std::size_t k = 0; k < roots.size(); ++k)
        row.emplace_back(values[line * roots.size() + k]);
      table.add_row(row);
    }
    table.write(folder + "/mode_amplitudes.csv");
  }

  nlohmann::ordered_json ModeRecorder::json(const double from, const double to) const
  {
    nlohmann::ordered_json result = nlohmann::ordered_json::array();
    const std::vector<StabilityRoot> &roots = projection.roots();
    for (std::size_t k = 0; k < roots.size(); ++k)
    {
      std::vector<double> amplitudes, seen;
      for (std::size_t line = 0; line < times.size(); ++line)
      {
        amplitudes.push_back(values[line * roots.size() + k]);
        if (times[line] >= from && times[line] <= to)
          seen.push_back(amplitudes.back());
      }
      const AmplitudeGrowth fit = amplitude_growth(times, amplitudes, from, to);
      nlohmann::ordered_json one = {{"column", column_of_mode(k) + "_m_s"},
                                    {"label", roots[k].label},
                                    {"frequency_Hz", roots[k].frequency},
                                    {"root_growth_1_s", roots[k].growth},
                                    {"growth_1_s", nullptr},
                                    {"residual", fit.residual},
                                    {"growth_uncertainty_1_s", fit.uncertainty},
                                    {"window_s", {from, to}}};
      if (fit.is_exponential())
        one["growth_1_s"] = fit.growth;
      if (!seen.empty())
      {
        one["amplitude_begin_m_s"] = seen.front();
        one["amplitude_end_m_s"] = seen.back();
      }
      result.push_back(one);
    }
    return result;
  }
} // namespace vibrocontact
