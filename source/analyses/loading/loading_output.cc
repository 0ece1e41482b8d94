#include <vibrocontact/analyses/loading/loading_output.h>
#include <vibrocontact/output/answer_parts.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace vibrocontact
{
  namespace
  {
    /// null: not known
    nlohmann::ordered_json error_json(const double value)
    {
      return value < 0 ? nlohmann::ordered_json() : nlohmann::ordered_json(value);
    }

    /// Points in contact and the largest pressure among some points.
    void add_points(const ContactSolution &solution, const unsigned int first, const unsigned int end,
                    const ContactGrid &grid, nlohmann::ordered_json &json)
    {
      unsigned int stick = 0, slip = 0;
      double pressure = 0;
      for (unsigned int i = first; i < end; ++i)
      {
        stick += solution.status[i] == ContactStatus::stick;
        slip += solution.status[i] == ContactStatus::slip;
        pressure = std::max(pressure, solution.R[i] / grid.cell_area());
      }
      json["contact_points"] = json.value("contact_points", 0u) + stick + slip;
      json["stick_points"] = json.value("stick_points", 0u) + stick;
      json["slip_points"] = json.value("slip_points", 0u) + slip;
      json["max_pressure_Pa"] = std::max(json.value("max_pressure_Pa", 0.), pressure);
    }
  } // namespace

  nlohmann::ordered_json loading_step_json(const LoadHistory::Step &step, const LoadedState &state,
                                           const ContactInterface &interface)
  {
    const PlacedContacts &contacts = interface.contacts;
    nlohmann::ordered_json one;
    one["part"] = step.part;
    one["ends_part"] = step.ends_part;
    one["normal_force_N"] = state.force[2];
    one["tangential_force_N"] = {0. - state.force[0], 0. - state.force[1]};
    one["driving_force_N"] = {state.force[0], state.force[1]};
    one["displacement_m"] = {state.displacement[0], state.displacement[1]};
    one["approach_m"] = state.displacement[2] - *std::min_element(interface.gap.begin(), interface.gap.end());
    for (unsigned int k = 0; k < contacts.all.size(); ++k)
      add_points(state.solution, contacts.first_point(k),
                 contacts.first_point(k) + contacts.all[k].grid.n_points(), contacts.all[k].grid, one);
    one["dissipated_J"] = state.dissipated;
    one["dissipated_sum_J"] = state.dissipated_sum;
    one["stored_J"] = state.stored;
    one["work_sum_J"] = state.work_sum;
    one["solves"] = state.solves;
    one["iterations"] = state.iterations;
    one["residual"] = state.solution.residual;
    one["seconds"] = state.seconds;
    return one;
  }

  nlohmann::ordered_json loading_step_json(const LoadedState &state, const ContactInterface &interface,
                                           const unsigned int k)
  {
    const PlacedContacts &contacts = interface.contacts;
    const std::array<double, 3> force = contacts.resultants(state.solution.R)[k];
    nlohmann::ordered_json one;
    one["normal_force_N"] = force[0];
    one["tangential_force_N"] = {force[1], force[2]};
    const unsigned int first = contacts.first_point(k);
    const ContactGrid &grid = contacts.all[k].grid;
    add_points(state.solution, first, first + grid.n_points(), grid, one);
    return one;
  }

  nlohmann::ordered_json loading_json(const LoadHistory &history, const LoadingResult &result)
  {
    const LoadedState &last = result.last;
    nlohmann::ordered_json json;
    json["steps_asked"] = history.steps.size();
    json["force_given"] = history.force_given;
    json["dissipated_J"] = last.dissipated_sum;
    json["work_J"] = last.work_sum;
    json["stored_J"] = last.stored;
    json["estimated_error"] = error_json(*std::max_element(result.errors.begin(), result.errors.end()));
    json["estimated_errors"] = nlohmann::ordered_json::array();
    for (const double error : result.errors)
      json["estimated_errors"].push_back(error_json(error));
    json["estimated_error_dissipated"] = error_json(result.dissipated_error);
    if (!result.error_not_known.empty())
      json["error_not_known"] = result.error_not_known;
    json["status"] = result.failure.empty() ? "converged" : "not converged";
    return json;
  }

  Table loading_table(const nlohmann::ordered_json &steps)
  {
    // column and where its value stands in a step
    const std::vector<std::pair<std::string, std::string>> columns = {
        {"part", "/part"},
        {"normal_force_N", "/normal_force_N"},
        {"driving_force_x_N", "/driving_force_N/0"},
        {"driving_force_y_N", "/driving_force_N/1"},
        {"displacement_x_m", "/displacement_m/0"},
        {"displacement_y_m", "/displacement_m/1"},
        {"approach_m", "/approach_m"},
        {"contact_points", "/contact_points"},
        {"stick_points", "/stick_points"},
        {"slip_points", "/slip_points"},
        {"max_pressure_Pa", "/max_pressure_Pa"},
        {"dissipated_J", "/dissipated_J"},
        {"dissipated_sum_J", "/dissipated_sum_J"},
        {"stored_J", "/stored_J"},
        {"work_sum_J", "/work_sum_J"},
        {"iterations", "/iterations"},
        {"residual", "/residual"}};
    std::vector<std::string> names = {"step"};
    for (const auto &[name, place] : columns)
      names.push_back(name);
    Table table(names, {"Quasi-static loading, one row per step",
                        "driving forces act on body 1 by its hub, the contact's forces on it are opposite; "
                        "displacements and approach are those of the hub",
                        "dissipated: by friction in the step, and since the beginning"});
    for (const auto &one : steps)
    {
      std::vector<Table::Cell> row = {table.n_rows() + 1.};
      for (const auto &[name, place] : columns)
        row.emplace_back(one.at(nlohmann::ordered_json::json_pointer(place)).get<double>());
      table.add_row(row);
    }
    return table;
  }

  Table loading_patch_table(const LoadedContact &contact, const PlacedContacts &contacts,
                            const unsigned int k)
  {
    Table table(
        {"x_m", "y_m", "gap_m", "pressure_Pa", "traction_x_Pa", "traction_y_Pa", "slip_x_m", "slip_y_m",
         "displacement_x_m", "displacement_y_m", "status"},
        {"Contact patch after a step of quasi-static loading, one row per point",
         "gap > 0 open; pressure > 0 compression; tractions act on body 1; slip in the step and relative "
         "displacement since the beginning: body 1 minus body 2",
         "status: 0 open, 1 stick, 2 slip; tractions are constant on the point's cell"});
    const ContactSolution &solution = contact.state().solution;
    const DenseVector &moved = contact.displacement();
    const ContactGrid &grid = contacts.all[k].grid;
    const unsigned int n = contacts.n_points(), first = contacts.first_point(k);
    const double area = grid.cell_area();
    for (unsigned int i = 0; i < grid.n_points(); ++i)
    {
      const unsigned int point = first + i;
      table.add_row({grid.x(i), grid.y(i), solution.y[point], solution.R[point] / area,
                     solution.R[n + point] / area, solution.R[2 * n + point] / area, solution.y[n + point],
                     solution.y[2 * n + point], moved[n + point], moved[2 * n + point],
                     double(solution.status[point])});
    }
    return table;
  }

  std::vector<std::string> loading_answer(const nlohmann::ordered_json &loading)
  {
    using namespace answer_parts;
    const Json &steps = list(loading, "steps");
    Lines lines;
    if (steps.empty())
      return lines;
    const Json &last = steps.back(), &force = list(last, "driving_force_N"),
               &moved = list(last, "displacement_m");
    const auto at = [](const Json &values, const unsigned int d)
    { return values.size() > d ? values[d].get<double>() : 0.; };
    lines.push_back(
        text("%zu steps; at the end normal force %.6g N, driving force (%.6g, %.6g) N, displacement "
             "(%.6g, %.6g) um, approach %.6g um%s",
             steps.size(), number(last, "normal_force_N"), at(force, 0), at(force, 1), 1e6 * at(moved, 0),
             1e6 * at(moved, 1), 1e6 * number(last, "approach_m"),
             word(loading, "status") == "converged" ? "" : ", NOT converged"));
    lines.push_back(text("of %.0f points in contact %.0f stick; friction has taken %.6g J",
                         number(last, "contact_points"), number(last, "stick_points"),
                         number(loading, "dissipated_J")));
    if (is_given(loading, "estimated_error"))
      lines.push_back(text(
          "estimated error by the grid %.2g %% of what answers to the loads, %.2g %% of what "
          "friction has taken",
          100 * number(loading, "estimated_error"), 100 * number(loading, "estimated_error_dissipated")));
    else
      lines.push_back("error by the grid not known: " + word(loading, "error_not_known"));
    return lines;
  }
} // namespace vibrocontact
