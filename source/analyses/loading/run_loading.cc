#include <vibrocontact/analyses/loading/loading_output.h>
#include <vibrocontact/analyses/loading/loading_scene.h>
#include <vibrocontact/analyses/loading/run_loading.h>
#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/output/contact_patch.h>
#include <vibrocontact/output/verdict.h>
#include <vibrocontact/run/entries_of_contact.h>
#include <vibrocontact/run/prepare_pair.h>
#include <vibrocontact/run/swept_runs.h>

#include <algorithm>

namespace vibrocontact
{
  namespace
  {
    void print(const LoadingResult &result)
    {
      const LoadedState &last = result.last;
      Log &log = run_log();
      log.value("steps", result.steps_done);
      log.value("normal force at the end", last.force[2], "N");
      log.value("driving force x", last.force[0], "N");
      log.value("driving force y", last.force[1], "N");
      log.value("displacement x", last.displacement[0] * 1e6, "um");
      log.value("displacement y", last.displacement[1] * 1e6, "um");
      log.value("energy taken by friction", last.dissipated_sum, "J");
    }
  } // namespace

  void run_loading(const Parameters &parameters, const MeshedBodies &bodies,
                   const std::optional<MeasuredData> &measured, const std::string &folder, Results &results,
                   const std::function<void()> &save)
  {
    const auto pair = prepare_pair(parameters, bodies, measured, parameters.replaces_flexibility());
    results.reductions = reductions_json(bodies);
    save();

    run_log().block("Quasi-static loading");
    const LoadHistory history = parameters.loading.history();
    const LoadingGrids grids = loading_grids(pair->bodies, parameters.contacts, parameters.placed_contacts());
    const ContactInterface &interface = grids.own.interface;
    const PlacedContacts &contacts = interface.contacts;
    run_log().value("contact points", contacts.n_points());
    const unsigned int n_steps = history.steps.size();
    Progress progress("load steps", n_steps);
    // nothing is added beside it while a step's is referred to
    nlohmann::ordered_json &all = results.analyses["quasi_static_loading"];
    all["steps"] = nlohmann::ordered_json::array();
    const auto finished = [&](const unsigned int k, const LoadedContact &contact)
    {
      all["steps"].push_back(loading_step_json(history.steps[k], contact.state(), interface));
      const bool written = parameters.output.contact_patches == "always" ||
                           (parameters.output.contact_patches == "automatic" && history.steps[k].ends_part);
      for (unsigned int c = 0; c < contacts.all.size(); ++c)
      {
        const PlacedContact &placed = contacts.all[c];
        if (!placed.name.empty())
          all["contacts"][placed.name]["steps"].push_back(loading_step_json(contact.state(), interface, c));
        if (written)
          on_first_rank(
              [&]
              {
                loading_patch_table(contact, contacts, c)
                    .write(folder + "/" + with_contact("loading_patch", placed) + "_" +
                           std::to_string(k + 1) + ".csv");
              });
      }
      save();
      progress.advance();
    };
    const LoadingResult result =
        quasi_static_loading(history, parameters.contacts, parameters.contact_solver, grids, finished);
    all.update(loading_json(history, result));
    on_first_rank([&] { loading_table(all["steps"]).write(folder + "/loading.csv"); });
    if (!result.failure.empty())
      refuse("Step " + std::to_string(result.steps_done + 1) + " of " + std::to_string(n_steps) +
                 " of quasi-static loading: " + result.failure,
             results);
    print(result);
  }

  namespace
  {
    void loading_read(EntriesRead &entries, const Parameters &parameters)
    {
      BodyUse use;
      use.contact = use.loads = true;
      use.motion = parameters.replaces_flexibility();
      add_partners(entries, parameters, use);
      add_contacts_at_rest(entries, parameters);
      for (const ContactParameters &contact : parameters.contacts.all)
        add_friction_coefficient(entries, contact);
      add_load_history(entries, parameters);
      entries.add("Output", "Contact patches");
    }

    void do_loading(const AnalysisRun &on)
    {
      run_loading(on.parameters, on.bodies, on.measured, on.folder, on.results, on.save_sometimes);
    }

    PreparedRun prepare_loading(const AnalysisRun &on)
    {
      reduce_bodies(on.bodies, on.parameters.replaces_flexibility());
      return do_loading;
    }
  } // namespace

  Analysis loading_analysis()
  {
    return {{"quasi-static loading",
             "body 1 pressed and shifted on body 2 with friction, without time: a history of loads",
             2,
             true,
             false,
             "",
             {},
             "Loading"},
            loading_read,
            do_loading,
            false,
            {{"quasi_static_loading",
              "quasi-static loading",
              loading_answer,
              {"loading.csv", "loading_patch_*.csv", "figures/loading.png"}}},
            swept_runs(prepare_loading, {{"dissipated_J", "/quasi_static_loading/dissipated_J"},
                                         {"work_J", "/quasi_static_loading/work_J"},
                                         {"stored_J", "/quasi_static_loading/stored_J"},
                                         {"estimated_error", "/quasi_static_loading/estimated_error"}})};
  }
} // namespace vibrocontact
