#include <vibrocontact/analyses/transient/judge_transient.h>
#include <vibrocontact/marching/judge_march.h>
#include <vibrocontact/output/verdict.h>

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
  } // namespace

  void judge_transient(const TransientResult &result, const StepErrors *const estimated,
                       const bool interrupted, Results &results)
  {
    const StepErrors errors = estimated ? *estimated : StepErrors();
    const ErrorReport report = {
        "transient",
        "Transient",
        estimated ? "a run with twice the step" : "",
        {{"estimated_error", "impulse", errors.impulse},
         {"estimated_error_rms_force", "rms normal force", errors.rms_force, result.rms_force()},
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
        refuse("transient", open_energy(result.energy, "The time step is too long: take a smaller one."),
               results);
      else
        doubt(open_energy(result.energy, "The march ended early: mend what ended it first."), results);
    }
    judge_errors(errors, report, " Take a smaller Transient/Time step.", results);
  }
} // namespace vibrocontact
