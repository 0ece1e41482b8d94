#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/output/stability_output.h>
#include <vibrocontact/run/run_stability.h>
#include <vibrocontact/run/unstable_shapes.h>

#include <cstdio>

namespace vibrocontact
{
  namespace
  {
    void print(const StabilityResult &result)
    {
      Log &log = run_log();
      const auto line = [&](const StabilityRoot &root, const char *what)
      {
        char text[200];
        std::snprintf(text, sizeof text, "%s %12.3f Hz  growth %10.3f 1/s  %s", what, root.frequency,
                      root.growth, root.label.c_str());
        log.line(text);
      };
      log.value("normal force", result.normal_force, "N");
      log.value("points in contact", result.contact_points);
      for (const StabilityRoot *const root : result.unstable())
        line(*root, "unstable:");
      if (result.unstable().empty())
        line(result.nearest(), "stable; nearest root:");
    }
  } // namespace

  void run_stability(const Parameters &parameters, const MeshedBodies &bodies, const std::string &folder,
                     Results &results)
  {
    const auto prepared = prepare_pair(parameters, bodies, true);
    run_log().block("Stability");
    const ContactPair pair =
        contact_pair(prepared->bodies[0], prepared->bodies[1], parameters.contact_grid());
    run_log().value("modes", pair.n_modes());
    Progress progress("stability cases", rolling_cases(parameters.rolling, parameters.contact).size());
    const auto finished = [&](const StabilityResult &result)
    {
      print(result);
      progress.advance();
    };
    const std::vector<StabilityResult> all =
        stability(parameters.stability, parameters.rolling, parameters.contact, parameters.contact_solver,
                  pair, finished);
    StabilityOutcome outcome;
    outcome.results = all;
    on_first_rank([&] { stability_table(outcome).write(folder + "/stability.csv"); });
    results.analyses["stability"] = stability_json(outcome);
    if (parameters.output.fields)
      write_unstable_shapes(all.front(), pair, bodies, folder);
  }
} // namespace vibrocontact
