#include <vibrocontact/analyses/transient/judge_transient.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/marching/judge_march.h>
#include <vibrocontact/output/verdict.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace vibrocontact
{
  namespace
  {
    std::string open_energy(const EnergyAccount &energy, const std::string &remedy)
    {
      std::ostringstream text;
      text.precision(3);
      text << "The energy account of the transient does not close: " << energy.initial
           << " J at the start and " << energy.input() << " J put in, but " << energy.stored
           << " J stored at the end and " << energy.friction + energy.damping
           << " J taken by friction and damping; differences took " << energy.numerical()
           << " J (negative: they add energy), the imbalance is " << energy.imbalance() << " J. " << remedy;
      return text.str();
    }

    /// Mean kinetic energy of a mode where it vibrates: what follows a slow load has hardly any beside w^2 q^2 / 2 [J]
    double kinetic_energy(const TransientResult::ModalMotion &motion, const double omega)
    {
      constexpr double least_of_vibration = 0.1;
      if (motion.time <= 0)
        return 0;
      const double kinetic = motion.v_square / motion.time / 2,
                   variance =
                       std::max(0., motion.q_square / motion.time - std::pow(motion.q / motion.time, 2));
      return kinetic > least_of_vibration * omega * omega * variance / 2 ? kinetic : 0;
    }

    void judge_steps_of_period(const TransientResult &result, const std::vector<double> &omega,
                               Results &results)
    {
      constexpr double least_steps = 8, most_share = 0.5, least_energy = 1e-9;
      if (result.steps == 0 || result.modal_motions.empty())
        return;
      const double step = result.time / result.steps;
      double all = 0, fast = 0, strongest_energy = 0;
      unsigned int strongest = 0;
      for (unsigned int k = 0; k < omega.size(); ++k)
      {
        const double energy = kinetic_energy(result.modal_motions[k], omega[k]);
        all += energy;
        if (omega[k] * step * least_steps <= 2 * dealii::numbers::PI)
          continue;
        fast += energy;
        if (energy > strongest_energy)
        {
          strongest_energy = energy;
          strongest = k;
        }
      }
      if (!(fast > most_share * all) || fast <= least_energy * result.energy.available)
        return;
      const double period = 2 * dealii::numbers::PI / omega[strongest];
      refuse("The steps of the transient are too long for its motion: modes with fewer than " +
                 number_text(least_steps) + " steps in a period have " + percent_text(fast / all, 0) +
                 " of the kinetic energy in the second half of the run, the strongest, at " +
                 number_text(1 / period) + " Hz, has " + number_text(period / step) +
                 ". Take a Transient/Time step of " + number_text(period / least_steps) + " s or less.",
             results);
    }
  } // namespace

  void judge_transient(const TransientResult &result, const std::vector<double> &omega,
                       const bool adapts_steps, const StepErrors *const estimated, const bool interrupted,
                       Results &results)
  {
    const StepErrors errors = estimated ? *estimated : StepErrors();
    const ErrorReport report = {
        "transient",
        "Transient",
        estimated ? "a run with twice the step" : "",
        {{"estimated_error", "impulse", errors.impulse},
         {"estimated_error_rms_force", "rms normal force", errors.rms_force, result.rms_force()},
         {"estimated_error_rms_variation", "rms variation of the normal force", errors.rms_variation,
          result.rms_variation()},
         {"estimated_error_rms_tangential_force", "rms tangential force", errors.rms_tangential,
          result.rms_tangential()}}};
    nlohmann::ordered_json &json = results.analyses["transient"];
    say_errors(errors, report, json);
    if (estimated)
      json["error_estimate"]["seconds"] = errors.seconds;
    // an error up to then says nothing of the whole run
    if (!errors.failure.empty())
      doubt("The run with twice the step, from which the error is estimated, ended early: " + errors.failure,
            results);
    if (result.above_tolerance > 0)
      doubt(std::to_string(result.above_tolerance) +
                " steps of the Shortest time step are above the Error tolerance: make it shorter, or the "
                "tolerance larger.",
            results);
    if (interrupted)
      return;
    if (!(result.energy.open() <= most_open_energy * result.energy.available))
    {
      if (result.converged)
        refuse(open_energy(result.energy, "The time step is too long: take a smaller one."), results);
      else
        doubt(open_energy(result.energy, "The march ended early: mend what ended it first."), results);
    }
    judge_errors(errors, report, " Take a smaller Transient/Time step.", results);
    if (!adapts_steps)
      judge_steps_of_period(result, omega, results);
  }
} // namespace vibrocontact
