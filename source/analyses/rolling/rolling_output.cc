#include <vibrocontact/analyses/rolling/rolling_output.h>
#include <vibrocontact/base/atomic_file.h>
#include <vibrocontact/output/answer_parts.h>
#include <vibrocontact/output/contact_patch.h>

#include <algorithm>
#include <sstream>
#include <utility>

namespace vibrocontact
{
  nlohmann::ordered_json rolling_case_json(const RollingResult &result)
  {
    nlohmann::ordered_json one = rolling_case_json(result, result);
    for (const ContactResultants &contact : result.contacts)
      if (contact.friction != result.friction)
        one["friction"] = nullptr; // each contact has its own
    return one;
  }

  nlohmann::ordered_json rolling_case_json(const RollingResult &result, const ContactResultants &of)
  {
    const ContactSolution &s = result.solution;
    nlohmann::ordered_json one;
    one["curve"] = result.rolling_case.curve;
    one["longitudinal_creepage"] = result.rolling_case.creepage.longitudinal;
    one["lateral_creepage"] = result.rolling_case.creepage.lateral;
    one["spin_1_m"] = result.rolling_case.creepage.spin;
    one["speed_m_s"] = result.rolling_case.creepage.speed;
    one["friction"] = of.friction;
    one["normal_force_N"] = of.normal_force;
    one["tangential_force_N"] = {of.tangential_force[0], of.tangential_force[1]};
    one["spin_moment_Nm"] = of.spin_moment;
    // null: not known
    const auto error = [](const double value)
    { return value < 0 ? nlohmann::ordered_json() : nlohmann::ordered_json(value); };
    one["normal_force_error_N"] = error(of.normal_force_error);
    one["force_error_N"] = error(of.force_error);
    one["spin_moment_error_Nm"] = error(of.moment_error);
    if (of.force_error < 0 && of.contact_points > 0)
      one["error_not_known"] = of.error_not_known;
    one["utilisation"] = of.utilisation;
    one["approach_m"] = of.approach;
    one["max_pressure_Pa"] = of.max_pressure;
    one["contact_points"] = of.contact_points;
    one["stick_points"] = of.stick_points;
    one["slip_points"] = of.slip_points;
    one["iterations"] = s.iterations;
    one["factorisations"] = s.factorisations;
    one["linear_iterations"] = s.linear_iterations;
    one["fallbacks"] = s.fallbacks;
    one["residual"] = s.residual;
    one["seconds"] = s.seconds;
    one["status"] = s.converged ? "converged" : "not converged";
    return one;
  }

  Table contact_patch_table(const RollingResult &result, const PlacedContacts &contacts, const unsigned int k)
  {
    std::vector<std::string> columns = {"x_m", "y_m"};
    columns.insert(columns.end(), contact_patch_columns().begin(), contact_patch_columns().end());
    Table table(
        columns,
        {"Contact patch, one row per point; origin: nominal contact point; the contact travels towards -x",
         "gap > 0 open; pressure > 0 compression; tractions act on body 1; slip = body 1 minus body 2",
         "status: 0 open, 1 stick, 2 slip; tractions are constant on the point's cell"});
    const ContactGrid &grid = contacts.all[k].grid;
    for (unsigned int point = 0; point < grid.n_points(); ++point)
    {
      std::vector<Table::Cell> row = {grid.x(point), grid.y(point)};
      for (const double value : contact_patch_values(result.solution, grid, contacts.first_point(k) + point))
        row.emplace_back(value);
      table.add_row(row);
    }
    return table;
  }

  Table rolling_table(const nlohmann::ordered_json &cases)
  {
    // column and where its value stands in a case
    const std::vector<std::pair<std::string, std::string>> columns = {
        {"curve", "/curve"},
        {"longitudinal_creepage", "/longitudinal_creepage"},
        {"lateral_creepage", "/lateral_creepage"},
        {"spin_1_m", "/spin_1_m"},
        {"friction", "/friction"},
        {"normal_force_N", "/normal_force_N"},
        {"tangential_force_x_N", "/tangential_force_N/0"},
        {"tangential_force_y_N", "/tangential_force_N/1"},
        {"spin_moment_Nm", "/spin_moment_Nm"},
        {"normal_force_error_N", "/normal_force_error_N"},
        {"force_error_N", "/force_error_N"},
        {"spin_moment_error_Nm", "/spin_moment_error_Nm"},
        {"utilisation", "/utilisation"},
        {"approach_m", "/approach_m"},
        {"max_pressure_Pa", "/max_pressure_Pa"},
        {"contact_points", "/contact_points"},
        {"stick_points", "/stick_points"},
        {"slip_points", "/slip_points"},
        {"iterations", "/iterations"},
        {"residual", "/residual"}};
    std::vector<std::string> names;
    for (const auto &[name, place] : columns)
      names.push_back(name);
    names.emplace_back("converged");
    Table table(names, {"Quasi-static rolling, one row per case, in the order of results.json",
                        "forces and moment act on body 1; creepage = (velocity of body 1 - body 2) / speed; "
                        "converged: 1 yes, 0 no",
                        "friction: empty where contacts have different ones; errors: stated error of the "
                        "normal force (0 if it is given), the tangential force (length of the "
                        "vector) and the moment by the grid; empty: not known"});
    for (const auto &one : cases)
    {
      std::vector<Table::Cell> row;
      for (const auto &[name, place] : columns)
      {
        const auto &value = one.at(nlohmann::ordered_json::json_pointer(place));
        if (value.is_null())
          row.emplace_back(std::string());
        else if (value.is_string())
          row.emplace_back(value.get<std::string>());
        else
          row.emplace_back(value.get<double>());
      }
      row.emplace_back(one.at("status") == "converged" ? 1. : 0.);
      table.add_row(row);
    }
    return table;
  }

  namespace
  {
    double friction_bound(const nlohmann::ordered_json &one)
    {
      return answer_parts::number(one, "friction") * answer_parts::number(one, "normal_force_N");
    }

    /// Whether a case has a stated error.
    bool is_known(const nlohmann::ordered_json &one)
    {
      return one.contains("force_error_N") && one["force_error_N"].is_number();
    }
  } // namespace

  std::vector<std::string> rolling_answer(const nlohmann::ordered_json &rolling)
  {
    using namespace answer_parts;
    const Json &cases = list(rolling, "cases");
    Lines lines;
    if (cases.empty())
      return lines;
    const Json &last = cases.back(), &force = list(last, "tangential_force_N");
    if (cases.size() > 1)
    {
      std::size_t failed = 0, without_error = 0;
      double least = 1e300, most = -1e300, largest_error = -1;
      for (const Json &one : cases)
      {
        failed += word(one, "status") != "converged";
        least = std::min(least, number(one, "utilisation"));
        most = std::max(most, number(one, "utilisation"));
        if (is_known(one) && friction_bound(one) > 0)
          largest_error = std::max(largest_error, number(one, "force_error_N") / friction_bound(one));
        without_error += !is_known(one) && number(one, "contact_points") > 0;
      }
      std::string more;
      if (failed > 0)
        more += text(", %zu NOT converged", failed);
      if (largest_error >= 0)
        more += text(", error by the grid at most %.2g %% of friction's bound", 100 * largest_error);
      if (without_error > 0)
        more += text(", error by the grid not known of %zu", without_error);
      lines.push_back(text("%zu cases, utilisation of friction %.3g to %.3g%s; the last one:", cases.size(),
                           least, most, more.c_str()));
    }
    if (number(last, "contact_points") == 0)
    {
      lines.push_back("the bodies do not touch");
      return lines;
    }
    lines.push_back(text("normal force %.6g N, tangential force (%.6g, %.6g) N, utilisation %.4g of ",
                         number(last, "normal_force_N"), force.size() > 0 ? force[0].get<double>() : 0.,
                         force.size() > 1 ? force[1].get<double>() : 0., number(last, "utilisation")) +
                    (is_given(last, "friction") ? text("friction %g", number(last, "friction"))
                                                : "the friction of its contacts") +
                    (word(last, "status") == "converged" ? "" : ", NOT converged"));
    if (last.contains("error_not_known"))
      lines.push_back("error by the grid not known: " + word(last, "error_not_known"));
    if (is_known(last))
      lines.push_back(text("tangential force +- %.3g N%s and spin moment %.4g +- %.2g Nm by the grid",
                           number(last, "force_error_N"),
                           friction_bound(last) > 0
                               ? text(" (%.2g %% of friction's bound)",
                                      100 * number(last, "force_error_N") / friction_bound(last))
                                     .c_str()
                               : "",
                           number(last, "spin_moment_Nm"), number(last, "spin_moment_error_Nm")));
    if (is_known(last) && number(last, "normal_force_error_N") > 0)
      lines.push_back(text("normal force +- %.3g N by the grid", number(last, "normal_force_error_N")));
    lines.push_back(text("largest pressure %.4g MPa, approach %.4g mm; of %.0f points in contact %.0f stick",
                         1e-6 * number(last, "max_pressure_Pa"), 1e3 * number(last, "approach_m"),
                         number(last, "contact_points"), number(last, "stick_points")));
    return lines;
  }
} // namespace vibrocontact
