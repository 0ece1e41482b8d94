#include <vibrocontact/analyses/transient/judge_transient.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/run/verdict.h>

#include <cmath>
#include <sstream>

namespace vibrocontact
{
  namespace
  {
    std::string open_energy(const EnergyAccount &energy)
    {
      std::ostringstream text;
      text.precision(3);
      text << "The energy account of the transient does not close: " << energy.initial
           << " J at the start and " << energy.input() << " J put in, but " << energy.stored
           << " J stored at the end and " << energy.friction + energy.damping
           << " J taken by friction and damping; differences took " << energy.numerical()
           << " J (negative: they add energy), the imbalance is " << energy.imbalance()
           << " J. The time step is too long: take a smaller one.";
      return text.str();
    }

    void say_errors(const TransientResult &result, const CoarseRun &coarse, nlohmann::ordered_json &json,
                    Results &results)
    {
      const StepErrors &errors = coarse.errors;
      json["error_estimate"] = {{"method", "a run with twice the step"},
                                {"until_s", errors.time},
                                {"seconds", coarse.sums.seconds}};
      if (!coarse.sums.converged)
      {
        std::ostringstream text;
        text << "The run with twice the step, from which the error is estimated, ended at "
             << coarse.sums.time << " s: " << coarse.sums.message;
        doubt(text.str() + (text.str().back() == '.' ? "" : "."), results);
        // an error up to then says nothing of the whole run
        run_log().value("estimated error of the steps", "unknown");
        return;
      }
      if (errors.time <= 0)
      {
        run_log().value("estimated error of the steps", "unknown: fewer than two steps were made");
        return;
      }
      if (!std::isfinite(errors.impulse) || !std::isfinite(errors.rms_force))
        return;
      json["estimated_error"] = errors.impulse;
      json["estimated_error_rms_force"] = errors.rms_force;
      json["estimated_error_rms_tangential_force"] = errors.rms_tangential;
      run_log().value("estimated error of the impulse", percent_text(errors.impulse));
      run_log().value("of the rms normal force",
                      percent_text(errors.rms_force) + " of " + number_text(result.rms_force()) + " N");
      if (result.rms_tangential() > 0)
        run_log().value("of the rms tangential force", percent_text(errors.rms_tangential) + " of " +
                                                           number_text(result.rms_tangential()) + " N");
    }
  } // namespace

  void judge_transient(const TransientResult &result, const CoarseRun *const coarse, const bool interrupted,
                       Results &results)
  {
    if (coarse)
      say_errors(result, *coarse, results.analyses["transient"], results);
    else
      run_log().value("estimated error of the steps", "not asked for (Transient/Error estimate)");
    if (result.above_tolerance > 0)
      doubt(std::to_string(result.above_tolerance) +
                " steps of the Shortest time step are above the Error tolerance: make it shorter, or the "
                "tolerance larger.",
            results);
    if (interrupted)
      return;
    if (!(result.energy.open() <= most_open_energy * result.energy.available))
      refuse("transient", open_energy(result.energy), results);
    if (coarse && coarse->errors.time > 0 && !(coarse->errors.largest() <= most_step_error))
      refuse(
          "transient",
          "The steps of the transient are too long for its result: the error is estimated at " +
              percent_text(coarse->errors.impulse) + " of the impulse, " +
              percent_text(coarse->errors.rms_force) + " of the rms normal force and " +
              percent_text(coarse->errors.rms_tangential) +
              " of the rms tangential force, from a run with twice the step. Take a smaller Transient/Time "
              "step.",
          results);
  }
} // namespace vibrocontact
