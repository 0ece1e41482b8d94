#include <vibrocontact/output/periodic_output.h>
#include <vibrocontact/output/table.h>

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
                                   {"residual", solved.solution.residual},
                                   {"seconds", solved.seconds}};
    if (!solved.solution.converged)
      return json;
    json["tip_max_m"] = motion.tip_max;
    json["tip_min_m"] = motion.tip_min;
    json["energy_norm_J"] = motion.energy_norm;
    json["penetration_m"] = motion.penetration;
    json["impulse_Ns"] = motion.impulse;
    return json;
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
} // namespace vibrocontact
