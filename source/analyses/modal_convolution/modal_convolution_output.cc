#include <vibrocontact/analyses/modal_convolution/modal_convolution_output.h>
#include <vibrocontact/base/hdf5_file.h>
#include <vibrocontact/base/table.h>
#include <vibrocontact/output/answer_parts.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vibrocontact
{
  nlohmann::ordered_json contact_json(const PlacedContacts &contacts, const unsigned int k,
                                      const ModalConvolutionResult &result, const bool with_friction)
  {
    const unsigned int first = contacts.first_point(k), n = contacts.all[k].grid.n_points();
    const auto sum = [&](const std::vector<double> &values)
    { return std::accumulate(values.begin() + first, values.begin() + first + n, 0.); };
    nlohmann::ordered_json json = {
        {"first_point", first}, {"n_points", n}, {"impulse_Ns", sum(result.impulse)}};
    if (with_friction)
      json["tangential_impulse_Ns"] = sum(result.tangential_impulse);
    return json;
  }

  namespace
  {
    constexpr std::size_t most_events_in_json = 10000;

    std::vector<std::string> quantities(const bool friction)
    {
      if (friction)
        return {"displacement_m", "force_N", "road_m", "tangential_displacement_m", "tangential_force_N"};
      return {"displacement_m", "force_N", "road_m"};
    }

    std::string point_name(const unsigned int i)
    {
      return "point_" + std::to_string(i) + "_";
    }

    std::vector<std::string> columns(const unsigned int n_points, const bool friction)
    {
      std::vector<std::string> names = {"time_s"};
      for (unsigned int i = 0; i < n_points; ++i)
        for (const std::string &quantity : quantities(friction))
          names.push_back(point_name(i) + quantity);
      return names;
    }
  } // namespace

  ModalConvolutionHistory::ModalConvolutionHistory(const ModalConvolutionParameters &parameters,
                                                   const unsigned int n_points, const std::string &file)
      : every(std::max(1l, std::lround(parameters.history_interval / parameters.time_step))),
        friction(parameters.friction), rows(file, columns(n_points, friction)),
        row(1 + quantities(friction).size() * n_points)
  {
  }

  void ModalConvolutionHistory::add(const ModalConvolutionLines &lines)
  {
    for (unsigned int k = 0; k < lines.n_lines; ++k)
    {
      if ((lines.first_line + k) % every != 0)
        continue;
      row[0] = (lines.first_line + k) * lines.time_step;
      for (unsigned int i = 0; i < lines.n_points; ++i)
      {
        const unsigned int place = k * lines.n_points + i;
        double *const own = &row[1 + (friction ? 5 : 3) * i];
        own[0] = lines.displacement[place];
        own[1] = lines.force[place];
        own[2] = lines.road[place];
        if (friction)
        {
          own[3] = lines.tangential_displacement[place];
          own[4] = lines.tangential_force[place];
        }
      }
      rows.add(row);
    }
  }

  void ModalConvolutionHistory::exchange(CheckpointFile &file)
  {
    rows.exchange("histories", file);
  }

  void write_point_tables(const std::string &histories, const unsigned int n_points, const bool friction,
                          const std::string &folder)
  {
    std::vector<std::string>
        columns = quantities(friction),
        notes = {"", // which point
                 "displacement of body 1 > 0 away from the road, tread compression included; force > 0 is "
                 "compression",
                 "road: its height under the point, loading and indentation included, less the shape of "
                 "body 1; they touch where the displacement is the same"};
    columns.insert(columns.begin(), "time_s");
    if (friction)
      notes.push_back("tangential: along the road, > 0 forward; force on body 1");
    for (unsigned int i = 0; i < n_points; ++i)
    {
      notes[0] = "Contact point " + std::to_string(i) + " of a modal convolution";
      write_rows_as_table(histories, columns, point_name(i), notes,
                          folder + "/contact_point_" + std::to_string(i) + ".csv");
    }
  }

  void write_impacts(const ModalConvolutionResult &result, const std::string &folder)
  {
    Table table({"time_s", "point", "impulse_Ns"},
                {"Impacts in the order of time; impulse > 0 pushes body 1 away from the road",
                 "stepping methods: the force of the first closed step times the step"});
    for (const ContactEvent &event : result.impacts)
      table.add_row({event.time, double(event.point), event.impulse});
    table.write(folder + "/impacts.csv");
  }

  std::vector<NamedSignal> recorded_forces(const ModalConvolutionParameters &parameters,
                                           const ModalConvolutionResult &result, const std::string &histories)
  {
    Hdf5Reader file(histories + ".h5");
    const std::vector<double> time = file.numbers("time_s");
    if (time.size() < 2)
      return {};
    const auto sum = [&](const std::string &quantity)
    {
      Signal whole;
      whole.begin = time[0];
      whole.step = time[1] - time[0];
      whole.values.assign(time.size(), 0.);
      for (unsigned int i = 0; i < result.impulse.size(); ++i)
      {
        const std::vector<double> force = file.numbers(point_name(i) + quantity);
        std::transform(force.begin(), force.end(), whole.values.begin(), whole.values.begin(), std::plus<>());
      }
      return whole;
    };
    std::vector<NamedSignal> forces = {{"normal_force", "N", sum("force_N"), false}};
    Signal &normal = forces[0].signal;
    if (parameters.is_event_located())
      for (const ContactEvent &event : result.impacts)
      {
        const std::size_t line = std::lround((event.time - time[0]) / normal.step);
        normal.values[std::min(line, time.size() - 1)] += event.impulse / normal.step;
      }
    if (parameters.friction)
      forces.push_back({"tangential_force", "N", sum("tangential_force_N"), false});
    return forces;
  }

  nlohmann::ordered_json modal_convolution_json(const ModalConvolutionParameters &parameters,
                                                const ModalConvolutionResult &result)
  {
    using Json = nlohmann::ordered_json;
    const double steps = std::max(1ul, result.steps);
    Json impacts = Json::array(), releases = Json::array();
    for (std::size_t k = 0; k < std::min(most_events_in_json, result.impacts.size()); ++k)
      impacts.push_back({{"time_s", result.impacts[k].time},
                         {"point", result.impacts[k].point},
                         {"impulse_Ns", result.impacts[k].impulse}});
    for (std::size_t k = 0; k < std::min(most_events_in_json, result.releases.size()); ++k)
      releases.push_back({{"time_s", result.releases[k].time}, {"point", result.releases[k].point}});
    Json json = {{"steps", result.steps},
                 {"time_s", result.time},
                 {"seconds_per_step", result.seconds / steps},
                 {"seconds_per_step_road", result.road_seconds / steps},
                 {"seconds_per_simulated_second",
                  (result.seconds + result.road_seconds) / std::max(1e-300, result.time)},
                 {"method", parameters.method},
                 {"force_shape", parameters.is_event_located() ? "exact" : parameters.force_shape},
                 {"time_step_s", parameters.time_step},
                 {"impacts", impacts},
                 {"releases", releases},
                 {"n_impacts", result.impacts.size()},
                 {"n_releases", result.releases.size()},
                 {"impulse_Ns", result.impulse},
                 {"largest_force_N", result.largest_force},
                 {"rms_force_N", result.rms_force()},
                 {"closed_points_mean", result.closed_points / steps}};
    const WorkAccount &work = result.work;
    json["energy"] = {{"input_J", work.input},
                      {"returned_J", work.returned},
                      {"impacts_J", work.impacts},
                      {"friction_J", work.friction},
                      {"body_J", work.work()}};
    if (work.has_modes)
      json["energy"].update({{"initial_J", work.initial},
                             {"stored_J", work.stored},
                             {"damping_J", work.damping},
                             {"imbalance_J", work.imbalance()}});
    if (result.has_residual)
    {
      json["corrections_per_step"] = result.corrections / steps;
      json["contact_residual"] = result.residual;
    }
    if (parameters.friction)
    {
      json["tangential_impulse_Ns"] = result.tangential_impulse;
      json["friction_J"] = result.dissipation;
      json["sticking_points_mean"] = result.sticking_points / steps;
    }
    return json;
  }

  std::vector<std::string> modal_convolution_answer(const nlohmann::ordered_json &run)
  {
    using namespace answer_parts;
    Lines lines;
    double impulse = 0;
    for (const Json &one : list(run, "impulse_Ns"))
      impulse += one.get<double>();
    const std::size_t n_points = list(run, "impulse_Ns").size();
    lines.push_back(text(
        "impulse %.6g N s%s in %.4g s, %.0f impacts, %.0f releases; %.3g points closed on average", impulse,
        n_points > 1 ? text(" of %zu points together", n_points).c_str() : "", number(run, "time_s"),
        number(run, "n_impacts"), number(run, "n_releases"), number(run, "closed_points_mean")));
    if (is_given(run, "estimated_error"))
      lines.push_back(
          text("estimated error of the steps: %.2g %% of the impulse", 100 * number(run, "estimated_error")) +
          (is_given(run, "estimated_error_rms_force")
               ? text(", %.2g %% of the rms force", 100 * number(run, "estimated_error_rms_force"))
               : ""));
    return lines;
  }
} // namespace vibrocontact
