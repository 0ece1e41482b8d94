#include <vibrocontact/analyses/contact_pair.h>
#include <vibrocontact/analyses/transient.h>
#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/output/transient_output.h>
#include <vibrocontact/run/run_transient.h>

#include <sstream>

namespace vibrocontact
{
  namespace
  {
    void print(const TransientResult &result)
    {
      Log &log = run_log();
      log.value("steps", static_cast<unsigned long long>(result.steps));
      log.value("time", result.time, "s");
      log.value("per step", result.seconds / std::max(1ul, result.steps) * 1e6, "us");
      log.value("solver iterations per step", result.iterations / std::max(1., double(result.steps)));
      log.value("normal impulse", result.impulse, "N s");
      log.value("energy stored at the end", result.energy.stored, "J");
      log.value("energy imbalance", result.energy.imbalance(), "J");
    }
  } // namespace

  void run_transient(const Parameters &parameters, const MeshedBodies &bodies, const std::string &folder,
                     Results &results)
  {
    const auto prepared = prepare_pair(parameters, bodies, true);
    run_log().block("Transient");
    const TransientParameters &transient_parameters = parameters.transient;
    const ContactPair pair =
        contact_pair(prepared->bodies[0], prepared->bodies[1], parameters.contact_grid());
    run_log().value("modes", pair.n_modes());
    run_log().value("contact points", pair.n_points());
    const DriveFunction drive =
        drive_function(transient_parameters, rolling_cases(parameters.rolling, parameters.contact).front());
    DynamicState state =
        initial_state(transient_parameters, parameters.contact, parameters.contact_solver, pair, drive(0));
    const double quiet = longest_quiet_step(pair);
    if (transient_parameters.integrator == "exact propagator" && transient_parameters.time_step > quiet)
    {
      std::ostringstream text;
      text << "Transient/Time step is " << transient_parameters.time_step << " s, but beyond " << quiet
           << " s reactions that are linear in the step ring: take a smaller one or the theta method.";
      run_log().warning(text.str());
    }
    const auto law = parameters.contact.law();
    TransientHistory history(pair, *law, transient_parameters.history_interval);
    history.add(state);
    Progress progress("transient", transient_parameters.end_time / transient_parameters.time_step);
    const auto observe = [&](const DynamicState &now, const TransientResult &)
    {
      history.add(now);
      progress.advance();
      return true;
    };
    const TransientResult result = transient(transient_parameters, parameters.contact,
                                             parameters.contact_solver, pair, drive, state, observe);
    on_first_rank([&] { history.write(folder + "/histories.h5"); });
    results.analyses["transient"] = transient_json(result, state);
    if (!result.converged)
    {
      std::ostringstream text;
      text << "The transient ended at " << result.time << " s: " << result.message
           << (result.message.back() == '.' ? "" : ".");
      results.converged = false;
      results.messages.push_back(text.str());
      run_log().warning(text.str());
    }
    print(result);
  }
} // namespace vibrocontact
