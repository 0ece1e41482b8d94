#include <vibrocontact/analyses/limit_cycle/balanced_cycle.h>
#include <vibrocontact/analyses/limit_cycle/basins_output.h>
#include <vibrocontact/analyses/limit_cycle/branch_output.h>
#include <vibrocontact/analyses/limit_cycle/limit_cycle_answer.h>
#include <vibrocontact/analyses/limit_cycle/limit_cycle_output.h>
#include <vibrocontact/analyses/limit_cycle/run_basins.h>
#include <vibrocontact/analyses/limit_cycle/run_branch.h>
#include <vibrocontact/analyses/limit_cycle/run_limit_cycle.h>
#include <vibrocontact/analyses/stability/pair_in_time.h>
#include <vibrocontact/analyses/transient/check_transient.h>
#include <vibrocontact/analyses/transient/transient.h>
#include <vibrocontact/analyses/transient/transient_probes.h>
#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/memory.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/base/run_communicator.h>
#include <vibrocontact/output/verdict.h>
#include <vibrocontact/run/entries_of_contact.h>
#include <vibrocontact/run/swept_runs.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace vibrocontact
{
  namespace
  {
    /// of the frequencies in Limit cycle/Roots
    constexpr double same_frequency = 1e-2;
    /// What a march over a period keeps for its derivative. @throws MachineError if the machine has too little
    void check_memory(const std::size_t n_loaded, const unsigned int n_steps)
    {
      const std::string shortage =
          memory_shortage("the derivatives of " + std::to_string(n_steps) +
                              " steps (a longer Limit cycle/Time step needs fewer)",
                          8. * n_steps * 9 * n_loaded * n_loaded, run_communicator());
      if (!shortage.empty())
        throw MachineError(shortage);
    }

    /// Those that Limit cycle/Roots asks for.
    std::vector<StabilityRoot> asked_roots(const std::vector<StabilityRoot> &unstable,
                                           const std::vector<double> &frequencies)
    {
      if (frequencies.empty())
        return unstable;
      std::vector<StabilityRoot> result;
      for (const double frequency : frequencies)
      {
        const auto nearest =
            std::min_element(unstable.begin(), unstable.end(),
                             [&](const StabilityRoot &a, const StabilityRoot &b) {
                               return std::abs(a.frequency - frequency) < std::abs(b.frequency - frequency);
                             });
        if (nearest == unstable.end() ||
            std::abs(nearest->frequency - frequency) > same_frequency * nearest->frequency)
        {
          std::string list;
          for (const StabilityRoot &root : unstable)
            list += (list.empty() ? "" : ", ") + number_text(root.frequency);
          throw InputError("Limit cycle/Roots has " + number_text(frequency) + " Hz, but " +
                           (list.empty() ? "no root of the equilibrium grows"
                                         : "the roots of the equilibrium that grow are at " + list + " Hz") +
                           ": leave the entry empty for all.");
        }
        for (const StabilityRoot &root : result)
          if (root.frequency == nearest->frequency)
            throw InputError("Limit cycle/Roots names the root at " + number_text(root.frequency) +
                             " Hz twice: leave one of them out.");
        result.push_back(*nearest);
      }
      return result;
    }

    /// The one that a motion is nearest to, of those that grow if any does: what decays about the equilibrium may be large and
    /// without contact.
    std::vector<StabilityRoot> root_of_motion(const CycleScene &scene, const TransientParameters &steps,
                                              const ContactSolverParameters &solver,
                                              const DynamicState &motion)
    {
      const std::vector<unsigned int> points =
          points_around(scene.pair->interface.contacts, scene.at_rest.R, *std::begin(spreads_of_contact));
      const auto any = map_about(scene, steps, solver, points, 1);
      const std::vector<StabilityRoot> all = roots_of(scene), unstable = unstable_of(all);
      return {nearest_root(*any, *scene.pair, scene.at_rest, unstable.empty() ? all : unstable, motion)};
    }

    /// Why the end of a transient may lead to no cycle, and what to do.
    std::string advice_for_motion(const StabilityRoot &nearest)
    {
      return nearest.growth < 0
                 ? "; no root of the equilibrium grows, so that small motions decay to rest"
                 : "; it may be far from one still: let the transient go on for longer, or set "
                   "Limit cycle/Start to roots";
    }

    std::string without_period(const std::string &sentence)
    {
      return sentence.empty() || sentence.back() != '.' ? sentence : sentence.substr(0, sentence.size() - 1);
    }

    void print(const LimitCycle &cycle)
    {
      Log &log = run_log();
      log.line((cycle.motion.empty() ? "" : "from the " + cycle.motion + ", near the ") + "root at " +
               number_text(cycle.root.frequency) + " Hz, growth " + number_text(cycle.root.growth) +
               " 1/s, " + cycle.root.label + ": " +
               (cycle.converged ? "cycle at " + number_text(1 / cycle.period) + " Hz" : cycle.message) +
               ", " + std::to_string(cycle.newton_iterations) + " Newton iterations, " +
               std::to_string(cycle.n_marched_steps) + " steps, " + number_text(cycle.seconds) + " s");
      if (cycle.stability && !cycle.stability->multipliers.empty())
        log.line("  disturbances grow by " + number_text(cycle.stability->multipliers.front().growth) +
                 " 1/s at most; trivial multiplier off by " + number_text(cycle.stability->trivial_error) +
                 ", " + number_text(cycle.stability_seconds) + " s");
    }

    void print(const BalancedCycle &cycle)
    {
      run_log().line("  harmonic balance, " + std::to_string(cycle.n_harmonics) + " harmonics: " +
                     (cycle.converged ? number_text(1 / cycle.period) + " Hz" : cycle.message) + ", " +
                     std::to_string(cycle.newton_iterations) + " Newton iterations, " +
                     std::to_string(cycle.n_products) + " products, " + number_text(cycle.seconds) + " s");
    }

    /// The cycle by harmonic balance as well, said number by number; those that are not found are refused.
    std::vector<BalancedCycle> balanced_cycles(const AnalysisRun &on, const CycleScene &scene,
                                               const LimitCycle &cycle, const CycleForces &by_steps,
                                               const std::vector<Probe> &probes)
    {
      const std::vector<BalancedCycle> balanced =
          balance_cycle(scene, cycle, by_steps, on.parameters.limit_cycle, probes);
      for (const BalancedCycle &one : balanced)
      {
        print(one);
        if (!one.converged)
          refuse("limit cycle",
                 "The cycle at " + number_text(1 / cycle.period) +
                     " Hz was not found by harmonic balance with " + std::to_string(one.n_harmonics) +
                     " harmonics: " + without_period(one.message) + ".",
                 on.results);
      }
      return balanced;
    }

    void run_limit_cycle(const AnalysisRun &on)
    {
      const Parameters &parameters = on.parameters;
      const LimitCycleParameters &own = parameters.limit_cycle;
      // the steps alone: what else a march is given belongs to it
      TransientParameters steps;
      steps.integrator = parameters.transient.integrator;
      steps.theta = parameters.transient.theta;
      steps.residual_theta = parameters.transient.residual_theta;
      steps.reaction = parameters.transient.reaction;
      std::vector<Probe> probes = transient_probes(parameters, on.bodies);
      const PairInTime in_time = prepare_pair_in_time(parameters, on.bodies, on.measured);
      run_log().block("Limit cycles");
      const auto held = std::make_shared<const ContactPair>(
          contact_pair(in_time.prepared->bodies, parameters.contacts, parameters.placed_contacts()));
      const RollingCase constants = rolling_cases(parameters.rolling, parameters.contacts).front();
      const CycleScene scene = cycle_scene(parameters, steps, held, parameters.contacts, constants);
      const ContactPair &pair = *scene.pair;
      place_in_pair(parameters, pair, probes);
      const DynamicState &at_rest = scene.at_rest;
      run_log().value("modes", pair.n_modes());
      if (pair.n_poles() > 0)
        run_log().value("poles", pair.n_poles());
      run_log().value("contact points", pair.n_points());
      run_log().value("hub", hub_text(parameters.hub()));

      std::optional<DynamicState> from;
      if (own.starts_from_transient())
        on_all_ranks(
            [&]
            {
              from = end_of_transient(own.transient_folder.empty() ? on.folder : own.transient_folder, pair,
                                      "Limit cycle/Transient folder");
            });
      const std::vector<StabilityRoot> roots =
          from ? root_of_motion(scene, steps, parameters.contact_solver, *from)
               : asked_roots(unstable_of(roots_of(scene)), own.roots);
      if (own.basins.any())
        check_basins(roots, own.basins);
      on.results.analyses["limit_cycle"] = nlohmann::ordered_json::array();
      on.results.analyses["limit_cycle_search"] = {{"friction", parameters.largest_friction()},
                                                   {"loss", "viscous"},
                                                   {"hub", parameters.hub()},
                                                   {"not_found", nlohmann::ordered_json::array()}};
      nlohmann::ordered_json &cycles = on.results.analyses["limit_cycle"],
                             &search = on.results.analyses["limit_cycle_search"];
      if (from)
        search["from_transient"] = {{"end_s", from->time}};
      if (!in_time.roots.is_null())
        search["roots_beside_rail"] = in_time.roots;
      if (!in_time.wrong.empty())
        refuse("limit cycle", in_time.wrong, on.results);
      std::vector<CycleOfBasin> found;
      Progress progress("limit cycles", std::max<std::size_t>(1, roots.size()));
      const std::size_t n_loaded = loaded_points(at_rest.R, pair.n_points()).size();
      for (std::size_t k = 0; k < roots.size(); ++k)
      {
        check_memory(n_loaded, steps_of_period(roots[k], own));
        std::unique_ptr<CycleMap> map;
        LimitCycle cycle;
        unsigned int n_tried = 0;
        for (const unsigned int spread : spreads_of_contact)
        {
          ++n_tried;
          const std::vector<unsigned int> points = points_around(pair.interface.contacts, at_rest.R, spread);
          map = map_about(scene, steps, solver_of_cycles(parameters.contact_solver), points,
                          steps_of_period(roots[k], own));
          cycle = find_limit_cycle(*map, pair, at_rest, roots[k], own, from ? &*from : nullptr);
          if (from)
            cycle.motion = own.name_of_start();
          if (cycle.converged || !map->left_its_points)
            break;
        }
        std::optional<CyclePeriod> period;
        if (cycle.converged)
          try
          {
            period = listen_to_cycle(*map, cycle, pair, parameters.contacts, probes);
          }
          catch (const InputError &error)
          {
            cycle.converged = false;
            cycle.message = error.what();
          }
        print(cycle);
        if (period)
        {
          cycles.push_back(cycle_json(cycle, *period, own.n_multipliers));
          cycles.back()["number"] = k + 1;
          on_first_rank(
              [&]
              {
                const std::string name = on.folder + "/limit_cycle_" + std::to_string(k + 1);
                cycle_table(*period).write(name + ".csv");
                harmonics_table(*period, 1 / cycle.period).write(name + "_harmonics.csv");
              });
          found.push_back({static_cast<unsigned int>(k + 1), map->unpack(cycle.state), cycle.root,
                           cycle.period, cycle.stability && cycle.stability->is_unstable()});
          CycleForces by_steps;
          if (!own.harmonics.empty())
            by_steps = forces_of_period(*map, cycle.state, cycle.period);
          map.reset(); // the derivatives of its steps take as much memory as what follows
          if (!own.harmonics.empty())
          {
            cycles.back()["harmonic_balance"] =
                balance_json(balanced_cycles(on, scene, cycle, by_steps, probes), *period, cycle.period);
            on_first_rank([&]
                          { balance_table(cycles).write(on.folder + "/limit_cycle_harmonic_balance.csv"); });
          }
          if (own.branch.any())
          {
            const auto was_lost = [&](const std::string &where, const std::string &why)
            {
              refuse("limit cycle",
                     "The branch of the cycle at " + number_text(1 / cycle.period) + " Hz over " +
                         own.branch.entry + " " + where + ": " + without_period(why) + ".",
                     on.results);
            };
            try
            {
              const auto keep = [&](const std::vector<nlohmann::ordered_json> &points)
              {
                cycles.back()["branch"] = {{"entry", own.branch.entry}, {"points", points}};
                on.save_sometimes();
              };
              const nlohmann::ordered_json branch =
                  run_branch({parameters, steps, held, scene, constants, n_tried - 1, probes, keep}, cycle);
              cycles.back()["branch"] = branch;
              for (const char *const end : {"begin", "end"})
                if (branch[end].contains("reason"))
                  was_lost("ended at " + number_text(branch[end]["value"].get<double>()),
                           branch[end]["reason"].get<std::string>());
              on_first_rank([&] { branch_table(cycles).write(on.folder + "/limit_cycle_branch.csv"); });
            }
            catch (const ConvergenceError &error)
            {
              cycles.back().erase("branch");
              was_lost("was not begun", error.what());
            }
          }
        }
        else
        {
          search["not_found"].push_back(failed_json(cycle));
          refuse("limit cycle",
                 "No limit cycle was found from the " +
                     std::string(cycle.motion.empty() ? "" : cycle.motion + ", near the ") + "root at " +
                     number_text(cycle.root.frequency) + " Hz: " + without_period(cycle.message) +
                     (cycle.motion.empty() ? "" : advice_for_motion(cycle.root)) + ".",
                 on.results);
        }
        on.save_sometimes();
        progress.advance();
      }
      add_sums(cycles, search);
      on_first_rank([&]
                    { cycles_table(cycles, search["not_found"]).write(on.folder + "/limit_cycles.csv"); });
      // another object among the results moves those that cycles and search refer to
      if (own.basins.any())
      {
        on.save();
        run_basins(on, scene, steps, found);
      }
    }

    /// Bodies with their modes, and shapes where probes are, are made by all ranks.
    PreparedRun prepare_limit_cycle(const AnalysisRun &on)
    {
      request_probe_shapes(on.parameters, on.bodies);
      reduce_bodies(on.bodies, true);
      return run_limit_cycle;
    }

    void limit_cycle_read(EntriesRead &entries, const Parameters &parameters)
    {
      add_motion_in_contact(entries, parameters);
      entries.add("Rolling", "Speed, Normal force, Hub displacement");
      entries.add_if(parameters.rolling.creepage.speed > 0, "Rolling/Speed is above 0", "Rolling",
                     "Longitudinal creepage, Lateral creepage, Spin");
      add_sliding(entries, parameters);
      entries.add("Limit cycle",
                  "Start, Time step, Tolerance, Max Newton iterations, Multipliers, Harmonics");
      if (parameters.limit_cycle.starts_from_transient())
        entries.add("Limit cycle", "Transient folder");
      else
        entries.add("Limit cycle", "Roots");
      entries.add("Limit cycle/Branch", "Entry");
      entries.add_if(parameters.limit_cycle.branch.any(), "Limit cycle/Branch/Entry is given",
                     "Limit cycle/Branch", "Range, Most points, Largest step");
      entries.add("Limit cycle/Basins", "Starts");
      entries.add_if(parameters.limit_cycle.basins.any(), "Limit cycle/Basins/Starts is above 0",
                     "Limit cycle/Basins", "Size, Time step, Longest time, Border");
      entries.add("Transient", "Integrator, Reaction");
      entries.add_if(yields_beside_modes(parameters), "a body yields at contact points beside its modes",
                     "Transient", "Residual theta");
      entries.add_if(!parameters.transient.propagates_exactly(), "Transient/Integrator is theta method",
                     "Transient", "Theta");
      entries.add("Transient/Signals", "Probes");
    }
  } // namespace

  Analysis limit_cycle_analysis()
  {
    return {{"limit cycle",
             "periodic motions of stick and slip that unstable roots grow to, found without time going by",
             2,
             true,
             true,
             "",
             {},
             "Limit cycle"},
            limit_cycle_read,
            run_limit_cycle,
            false,
            {{"limit_cycle_search", "limit cycle", limit_cycle_search_answer, {}},
             {"limit_cycle",
              "the limit cycles",
              limit_cycle_answer,
              {"limit_cycles.csv", "limit_cycle_*.csv", "figures/limit_cycles.png",
               "figures/limit_cycle_harmonic_balance.png", "figures/limit_cycle_branches.png"}},
             {"limit_cycle_basins",
              "which limit cycle wins",
              basins_answer,
              {"limit_cycle_basins.csv", "limit_cycle_basin_paths.csv", "figures/limit_cycle_basins.png"}}},
            swept_runs(prepare_limit_cycle,
                       {{"roots", "/limit_cycle_search/roots"},
                        {"cycles", "/limit_cycle_search/cycles_found"},
                        {"loudest_frequency_Hz", "/limit_cycle_search/loudest/frequency_Hz"},
                        {"loudest_amplitude_m_s", "/limit_cycle_search/loudest/amplitude_m_s"},
                        {"loudest_amplitude_N", "/limit_cycle_search/loudest/amplitude_N"},
                        {"loudest_level_dB", "/limit_cycle_search/loudest/level_dB"},
                        {"loudest_power_into_body_1_W", "/limit_cycle_search/loudest/power_into_body_1_W"},
                        {"loudest_largest_growth_1_s", "/limit_cycle_search/loudest/largest_growth_1_s"}}),
            nullptr,
            [](const Parameters &parameters)
            {
              return parameters.limit_cycle.starts_from_transient() &&
                     parameters.limit_cycle.transient_folder.empty();
            }};
  }
} // namespace vibrocontact
