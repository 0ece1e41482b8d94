#include <vibrocontact/base/log.h>
#include <vibrocontact/output/periodic_output.h>
#include <vibrocontact/run/periodic_body.h>
#include <vibrocontact/run/run_periodic.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

namespace vibrocontact
{
  namespace
  {
    /// What is to be solved, the main solution first.
    std::vector<BalanceSettings> solutions(const PeriodicParameters &periodic, const double friction)
    {
      std::vector<BalanceSettings> result = {
          periodic.settings(periodic.trial, periodic.weighting, periodic.n_functions, friction)};
      for (const auto &[trial, weighting] : periodic.parsed_pairs())
        for (const unsigned int number : periodic.numbers)
          result.push_back(periodic.settings(trial, weighting, number, friction));
      return result;
    }

    void tell(const PeriodicCase &solved)
    {
      Log &log = run_log();
      log.value("basis", solved.settings.trial + ":" + solved.settings.weighting + ", " +
                             std::to_string(solved.settings.n_functions) + " functions");
      log.value("Newton iterations", solved.solution.iterations);
      if (solved.solution.homotopy_steps > 0)
        log.value("steps of the gap", solved.solution.homotopy_steps);
      if (solved.solution.converged)
      {
        log.value("largest displacement", solved.motion.tip_max, "m");
        log.value("impulse of a period", solved.motion.impulse[0], "N s");
      }
      log.value("time", solved.seconds * 1e3, "ms");
    }
  } // namespace

  void run_periodic(const Parameters &parameters, const MeshedBodies &bodies, const std::string &folder,
                    Results &results)
  {
    const PeriodicParameters &periodic = parameters.periodic;
    const bool writes = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
    run_log().block("Periodic motion");
    const PeriodicBody body = periodic_body(parameters, bodies);
    const auto law =
        periodic.normal_law(parameters.contact.penalty_amplitude, parameters.contact.penalty_exponent);
    if (periodic.law == "signorini" && !(body.residual(0, 0) > 0))
      run_log().warning(
          "the rigid stop meets a contact point with mass: its forces do not converge with the number of "
          "functions; give the body a massless contact node or keep fewer modes");

    nlohmann::ordered_json &json = results.analyses["periodic"] = nlohmann::ordered_json::array();
    for (const BalanceSettings &settings : solutions(periodic, parameters.contact.friction))
    {
      PeriodicBalance balance(body, law, settings);
      dealii::Timer timer;
      balance.set_force({periodic.force, periodic.frequency});
      PeriodicCase solved{settings, periodic.law, balance.solve(), {}, 0};
      solved.seconds = timer.wall_time();
      if (solved.solution.converged)
        solved.motion = sample_motion(balance, solved.solution, periodic.n_output);
      else
        results.failures.push_back(
            {"periodic", "The periodic motion by " + std::to_string(settings.n_functions) + " functions " +
                             settings.trial + ":" + settings.weighting + " did not converge (residual " +
                             std::to_string(solved.solution.residual) +
                             "): choose another number of functions."});
      tell(solved);
      if (writes && solved.solution.converged)
        write_periodic_table(solved, folder + "/periodic_" + std::to_string(json.size()) + ".csv");
      json.push_back(periodic_json(solved));
    }
  }
} // namespace vibrocontact
