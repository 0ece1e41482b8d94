#include <vibrocontact/analyses/periodic/periodic_output.h>
#include <vibrocontact/output/answer_parts.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  nlohmann::ordered_json periodic_json(const PeriodicCase &solved)
  {
    const PeriodicMotion &motion = solved.motion;
    nlohmann::ordered_json json = {{"basis", solved.settings.trial},
                                   {"weighting", solved.settings.weighting},
                                   {"form", name_of(solved.settings.form)},
                                   {"n_functions", solved.settings.n_functions},
                                   {"law", solved.law},
                                   {"frequency_Hz", solved.solution.excitation.frequency},
                                   {"period_s", 1 / solved.solution.excitation.frequency},
                                   {"converged", solved.solution.converged},
                                   {"newton_iterations", solved.solution.iterations},
                                   {"gap_steps", solved.solution.homotopy_steps},
                                   {"stiffness_steps", solved.solution.stiffness_steps},
                                   {"phases", solved.n_phases},
                                   {"failed_phases", solved.failed_phases},
                                   {"seconds", solved.seconds}};
    if (std::isfinite(solved.solution.residual))
      json["residual"] = solved.solution.residual;
    if (!solved.solution.converged)
      return json;
    json["tip_max_m"] = motion.tip_max;
    json["tip_min_m"] = motion.tip_min;
    if (!motion.energy.empty())
      json["energy_norm_J"] = motion.energy_norm;
    json["penetration_m"] = motion.penetration;
    json["impulse_Ns"] = motion.impulse;
    if (solved.errors)
    {
      json["error_to_reference"] = solved.errors->displacement;
      json["reference"] = "shooting in time";
      json["error_velocity"] = solved.errors->velocity;
      json["error_contact_force"] = solved.errors->contact_force;
      json["error_impulse"] = solved.errors->impulse;
      json["error_energy_norm"] = solved.errors->energy_norm;
      json["error_midpoints"] = solved.errors->midpoints;
    }
    return json;
  }

  nlohmann::ordered_json contacts_json(const PlacedContacts &contacts, const PeriodicMotion &motion)
  {
    nlohmann::ordered_json json;
    for (unsigned int k = 0; k < contacts.all.size(); ++k)
    {
      const unsigned int first = contacts.first_point(k), n = contacts.all[k].grid.n_points();
      std::vector<double> force(motion.phase.size());
      double impulse = 0;
      for (unsigned int p = first; p < first + n; ++p)
      {
        impulse += motion.impulse[p];
        for (unsigned int i = 0; i < force.size(); ++i)
          force[i] += motion.points[p].contact_force[i];
      }
      json[contacts.all[k].name] = {{"first_point", first},
                                    {"n_points", n},
                                    {"impulse_Ns", impulse},
                                    {"largest_force_N", *std::max_element(force.begin(), force.end())}};
    }
    return json;
  }

  void write_reference_table(const PeriodicReference &reference, const std::string &file_name)
  {
    Table table({"phase", "displacement_m", "velocity_m_s", "contact_force_N"},
                {"Periodic motion by shooting in time, the reference of periodic_errors.csv"});
    const std::size_t n = reference.displacement.size();
    for (std::size_t i = 0; i < n; ++i)
      table.add_row(
          {double(i) / n, reference.displacement[i], reference.velocity[i], reference.contact_force[i]});
    table.write(file_name);
  }

  void write_basis_table(const std::vector<std::string> &families, const TimeBases &bases,
                         const std::string &file_name)
  {
    constexpr unsigned int n_phases = 512, n_levels = 6;
    std::vector<std::string> columns = {"phase"};
    std::vector<std::vector<double>> values(n_phases);
    for (unsigned int i = 0; i < n_phases; ++i)
      values[i].push_back(double(i) / n_phases);
    for (const std::string &family : families)
      for (unsigned int level = 0; level < n_levels; ++level)
      {
        const bool fourier = family == "fourier";
        const auto basis = create_time_basis(family, fourier ? n_levels : 1u << level, bases);
        columns.push_back(family + "_" + (fourier ? std::to_string(level) : std::to_string(1u << level)));
        for (unsigned int i = 0; i < n_phases; ++i)
          values[i].push_back(basis->function(fourier ? level : 0, values[i][0], 0));
      }
    Table table(
        columns,
        {"Functions of the bases in time: fourier_<k> the k-th, others the first of so many functions"});
    for (const std::vector<double> &row : values)
      table.add_row({row.begin(), row.end()});
    table.write(file_name);
  }

  Table periodic_error_table()
  {
    return Table(
        {"basis", "weighting", "n_functions", "error_displacement", "error_velocity", "error_contact_force",
         "error_impulse", "error_energy_norm", "error_midpoints", "phases", "failed_phases",
         "newton_iterations", "seconds"},
        {"Relative rms errors of the first contact point against shooting in time, medians over positions of "
         "the force within a cell of the basis",
         "error_midpoints: of the displacement in the middle of the cells; iterations and seconds of one "
         "solution"});
  }

  void add_line(Table &table, const PeriodicCase &solved)
  {
    std::vector<Table::Cell> row = {solved.settings.trial, solved.settings.weighting,
                                    double(solved.settings.n_functions)};
    for (double PeriodicErrors::*entry :
         {&PeriodicErrors::displacement, &PeriodicErrors::velocity, &PeriodicErrors::contact_force,
          &PeriodicErrors::impulse, &PeriodicErrors::energy_norm, &PeriodicErrors::midpoints})
      row.push_back(solved.errors ? Table::Cell((*solved.errors).*entry) : Table::Cell(""));
    row.insert(row.end(), {double(solved.n_phases), double(solved.failed_phases),
                           double(solved.solution.iterations), solved.seconds});
    table.add_row(row);
  }

  void write_periodic_table(const PeriodicCase &solved, const std::string &file_name)
  {
    const PeriodicMotion &motion = solved.motion;
    std::vector<std::string> columns = {"phase"};
    for (unsigned int p = 0; p < motion.points.size(); ++p)
    {
      const std::string prefix = p == 0 ? "" : "point_" + std::to_string(p) + "_";
      for (const char *name : {"displacement_m", "velocity_m_s", "contact_force_N"})
        columns.push_back(prefix + name);
      if (!motion.points[p].tangential_force[0].empty())
        for (const char *name : {"tangential_displacement_1_m", "tangential_displacement_2_m",
                                 "tangential_force_1_N", "tangential_force_2_N"})
          columns.push_back(prefix + name);
    }
    Table table(columns,
                {"Periodic motion, " + solved.settings.trial + ":" + solved.settings.weighting + ", " +
                     std::to_string(solved.settings.n_functions) + " functions",
                 "phase 0 where the exciting force rises through zero; displacement > 0 towards the stop; "
                 "contact force > 0 is compression"});
    for (unsigned int i = 0; i < motion.phase.size(); ++i)
    {
      std::vector<Table::Cell> row = {motion.phase[i]};
      for (const PointHistory &point : motion.points)
      {
        row.insert(row.end(), {point.displacement[i], point.velocity[i], point.contact_force[i]});
        if (!point.tangential_force[0].empty())
          row.insert(row.end(), {point.tangential_displacement[0][i], point.tangential_displacement[1][i],
                                 point.tangential_force[0][i], point.tangential_force[1][i]});
      }
      table.add_row(row);
    }
    table.write(file_name);
  }

  std::vector<std::string> periodic_answer(const nlohmann::ordered_json &solutions)
  {
    using namespace answer_parts;
    Lines lines;
    if (solutions.empty())
      return lines;
    std::size_t failed = 0;
    for (const Json &one : solutions)
      failed += !one.value("converged", false);
    const Json &one = solutions.front();
    const std::string name = word(one, "basis") + ":" + word(one, "weighting") +
                             text(", %.0f functions, ", number(one, "n_functions"));
    if (!one.value("converged", false))
      lines.push_back(name + "NO solution found");
    else
    {
      lines.push_back(name + text("%.6g Hz: displacement %.5g to %.5g m", number(one, "frequency_Hz"),
                                  number(one, "tip_min_m"), number(one, "tip_max_m")));
      if (const Json &impulse = list(one, "impulse_Ns"); !impulse.empty())
        lines.back() += text(", impulse of a period %.5g N s", impulse[0].get<double>()) +
                        (impulse.size() > 1 ? text(" at the first of %zu points", impulse.size()) : "");
      if (is_given(one, "error_to_reference"))
        lines.back() += text("; error %.2g against shooting", number(one, "error_to_reference"));
    }
    if (solutions.size() > 1)
      lines.push_back(
          text("%zu further solutions%s", solutions.size() - 1,
               failed > 0 ? (", " + std::to_string(failed) + " of all without result").c_str() : ""));
    return lines;
  }
} // namespace vibrocontact
