#include <vibrocontact/analyses/limit_cycle/balanced_cycle.h>
#include <vibrocontact/analyses/limit_cycle/basins_output.h>
#include <vibrocontact/analyses/limit_cycle/branch_output.h>
#include <vibrocontact/analyses/limit_cycle/cycle_errors.h>
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
#include <vibrocontact/marching/judge_march.h>
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

    /// What the cycles of a run are sought with.
    struct CycleSearch
    {
      const AnalysisRun &on;
      /// the steps alone: what else a march is given belongs to it
      TransientParameters steps;
      /// with its hub held
      std::shared_ptr<const ContactPair> held;
      RollingCase constants;
      CycleScene scene;
      std::vector<Probe> probes;
      /// the motion that they are sought from; nothing: from the roots
      std::optional<DynamicState> from;

      const LimitCycleParameters &own() const { return on.parameters.limit_cycle; }
      const ContactPair &pair() const { return *scene.pair; }
      void refuse(const std::string &sentence) const
      {
        vibrocontact::refuse("limit cycle", sentence, on.results);
      }
    };

    TransientParameters steps_alone(const TransientParameters &transient)
    {
      TransientParameters steps;
      steps.integrator = transient.integrator;
      steps.theta = transient.theta;
      steps.residual_theta = transient.residual_theta;
      steps.reaction = transient.reaction;
      return steps;
    }

    /// The one that a motion is nearest to, of those that grow if any does: what decays about the equilibrium may be large and
    /// without contact.
    StabilityRoot root_of_motion(const CycleSearch &search)
    {
      const CycleScene &scene = search.scene;
      const std::vector<unsigned int> points =
          points_around(scene.pair->interface.contacts, scene.at_rest.R, *std::begin(spreads_of_contact));
      const auto any = map_about(scene, search.steps, search.on.parameters.contact_solver, points, 1);
      const std::vector<StabilityRoot> all = roots_of(scene), unstable = unstable_of(all);
      return nearest_root(*any, *scene.pair, scene.at_rest, unstable.empty() ? all : unstable, *search.from);
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

    /// A cycle as it was sought from one root.
    struct SoughtCycle
    {
      LimitCycle cycle;
      std::unique_ptr<CycleMap> map;
      /// which of spreads_of_contact its points have
      unsigned int spread = 0;
      /// nothing: it was not found
      std::optional<CyclePeriod> period;
    };

    SoughtCycle seek(const CycleSearch &search, const StabilityRoot &root)
    {
      const Parameters &parameters = search.on.parameters;
      const ContactPair &pair = search.pair();
      const DynamicState &at_rest = search.scene.at_rest;
      const unsigned int n_steps = steps_of_period(root, search.own());
      check_memory(loaded_points(at_rest.R, pair.n_points()).size(), n_steps);
      SoughtCycle sought;
      LimitCycle &cycle = sought.cycle;
      for (unsigned int spread = 0; spread < std::size(spreads_of_contact); ++spread)
      {
        sought.spread = spread;
        const std::vector<unsigned int> points =
            points_around(pair.interface.contacts, at_rest.R, spreads_of_contact[spread]);
        sought.map = map_about(search.scene, search.steps, solver_of_cycles(parameters.contact_solver),
                               points, n_steps);
        cycle = find_limit_cycle(*sought.map, pair, at_rest, root, search.own(),
                                 search.from ? &*search.from : nullptr);
        if (cycle.converged || !sought.map->left_its_points)
          break;
      }
      if (search.from)
        cycle.motion = search.own().name_of_start();
      if (cycle.converged)
        try
        {
          sought.period = listen_to_cycle(*sought.map, cycle, pair, parameters.contacts, search.probes);
        }
        catch (const InputError &error)
        {
          cycle.converged = false;
          cycle.message = error.what();
        }
      print(cycle);
      return sought;
    }

    std::string at_frequency(const LimitCycle &cycle)
    {
      return "the cycle at " + number_text(1 / cycle.period) + " Hz";
    }

    /// Estimates the errors of the steps; those that are too large, or not known, are refused.
    void add_errors(const CycleSearch &search, const SoughtCycle &sought,
                    const std::vector<unsigned int> &points, nlohmann::ordered_json &json)
    {
      const LimitCycle &cycle = sought.cycle;
      const CycleErrors errors =
          errors_of_steps(search.scene, search.steps, solver_of_cycles(search.on.parameters.contact_solver),
                          search.own(), points, cycle, *sought.period, search.probes);
      add_errors_json(errors, json);
      if (!errors.failure.empty())
        return search.refuse(
            "What the steps change in " + at_frequency(cycle) +
            " is not known, since it was found in no other number of steps: " +
            without_period(errors.failure) +
            ". Take a shorter Limit cycle/Time step, or set Limit cycle/Error estimate to false.");
      run_log().line("  estimated error of " + std::to_string(cycle.n_steps) + " steps: frequency " +
                     percent_text(errors.frequency) + ", " + errors.signal + " " +
                     percent_text(errors.amplitude) + " of its amplitude and " +
                     percent_text(errors.first_harmonic) + " of its first harmonic, " +
                     number_text(errors.seconds) + " s");
      if (errors.largest() > most_step_error)
        search.refuse(
            "The steps of " + at_frequency(cycle) + " are too long: with " + std::to_string(errors.n_steps) +
            " in a period, in place of " + std::to_string(cycle.n_steps) + ", the error is estimated at " +
            percent_text(errors.amplitude) + " of the amplitude, " + percent_text(errors.first_harmonic) +
            " of the first harmonic (" + errors.signal + ") and " + percent_text(errors.frequency) +
            " of the frequency. Take a shorter Limit cycle/Time step.");
    }

    /// The cycle by harmonic balance as well, said number by number; those that are not found are refused.
    void add_balance(const CycleSearch &search, const SoughtCycle &sought, const CycleForces &by_steps,
                     nlohmann::ordered_json &json)
    {
      const LimitCycle &cycle = sought.cycle;
      const std::vector<BalancedCycle> balanced =
          balance_cycle(search.scene, cycle, by_steps, search.own(), search.probes);
      for (const BalancedCycle &one : balanced)
      {
        print(one);
        if (!one.converged)
          search.refuse("The cycle at " + number_text(1 / cycle.period) +
                        " Hz was not found by harmonic balance with " + std::to_string(one.n_harmonics) +
                        " harmonics: " + without_period(one.message) + ".");
      }
      json["harmonic_balance"] = balance_json(balanced, *sought.period, cycle.period);
    }

    /// Follows a cycle over Limit cycle/Branch/Entry; a branch that is lost is refused.
    void add_branch(const CycleSearch &search, const SoughtCycle &sought, nlohmann::ordered_json &json)
    {
      const CycleBranchParameters &own = search.own().branch;
      const auto was_lost = [&](const std::string &where, const std::string &why)
      {
        search.refuse("The branch of " + at_frequency(sought.cycle) + " over " + own.entry + " " + where +
                      ": " + without_period(why) + ".");
      };
      const auto keep = [&](const std::vector<nlohmann::ordered_json> &points)
      {
        json["branch"] = {{"entry", own.entry}, {"points", points}};
        search.on.save_sometimes();
      };
      try
      {
        const nlohmann::ordered_json branch =
            run_branch({search.on.parameters, search.steps, search.held, search.scene, search.constants,
                        sought.spread, search.probes, keep},
                       sought.cycle);
        json["branch"] = branch;
        for (const char *const end : {"begin", "end"})
          if (branch[end].contains("reason"))
            was_lost("ended at " + number_text(branch[end]["value"].get<double>()),
                     branch[end]["reason"].get<std::string>());
      }
      catch (const ConvergenceError &error)
      {
        json.erase("branch");
        was_lost("was not begun", error.what());
      }
    }

    /// What was asked of a cycle that was found, into the last of `cycles` and into its files.
    void add_cycle(const CycleSearch &search, SoughtCycle &sought, const std::size_t number,
                   nlohmann::ordered_json &cycles)
    {
      const LimitCycleParameters &own = search.own();
      const AnalysisRun &on = search.on;
      cycles.push_back(cycle_json(sought.cycle, *sought.period, own.n_multipliers));
      cycles.back()["number"] = number;
      on_first_rank(
          [&]
          {
            const std::string name = on.folder + "/limit_cycle_" + std::to_string(number);
            cycle_table(*sought.period).write(name + ".csv");
            harmonics_table(*sought.period, 1 / sought.cycle.period).write(name + "_harmonics.csv");
          });
      CycleForces by_steps;
      if (!own.harmonics.empty())
        by_steps = forces_of_period(*sought.map, sought.cycle.state, sought.cycle.period);
      const std::vector<unsigned int> points = sought.map->points_that_may_touch();
      sought.map.reset(); // the derivatives of its steps take as much memory as what follows
      if (own.error_estimate)
        add_errors(search, sought, points, cycles.back());
      if (!own.harmonics.empty())
      {
        add_balance(search, sought, by_steps, cycles.back());
        on_first_rank([&] { balance_table(cycles).write(on.folder + "/limit_cycle_harmonic_balance.csv"); });
      }
      if (own.branch.any())
      {
        add_branch(search, sought, cycles.back());
        if (cycles.back().contains("branch"))
          on_first_rank([&] { branch_table(cycles).write(on.folder + "/limit_cycle_branch.csv"); });
      }
    }

    /// The same of a root from which none was found.
    void add_failure(const CycleSearch &search, const LimitCycle &cycle, nlohmann::ordered_json &not_found)
    {
      not_found.push_back(failed_json(cycle));
      search.refuse("No limit cycle was found from the " +
                    std::string(cycle.motion.empty() ? "" : cycle.motion + ", near the ") + "root at " +
                    number_text(cycle.root.frequency) + " Hz: " + without_period(cycle.message) +
                    (cycle.motion.empty() ? "" : advice_for_motion(cycle.root)) + ".");
    }

    CycleSearch prepare_search(const AnalysisRun &on, const PairInTime &in_time)
    {
      const Parameters &parameters = on.parameters;
      const TransientParameters steps = steps_alone(parameters.transient);
      const auto held = std::make_shared<const ContactPair>(
          contact_pair(in_time.prepared->bodies, parameters.contacts, parameters.placed_contacts()));
      const RollingCase constants = rolling_cases(parameters.rolling, parameters.contacts).front();
      CycleSearch search = {on,
                            steps,
                            held,
                            constants,
                            cycle_scene(parameters, steps, held, parameters.contacts, constants),
                            transient_probes(parameters, on.bodies),
                            {}};
      const ContactPair &pair = search.pair();
      place_in_pair(parameters, pair, search.probes);
      run_log().value("modes", pair.n_modes());
      if (pair.n_poles() > 0)
        run_log().value("poles", pair.n_poles());
      run_log().value("contact points", pair.n_points());
      run_log().value("hub", hub_text(parameters.hub()));
      const LimitCycleParameters &own = parameters.limit_cycle;
      if (own.starts_from_transient())
        on_all_ranks(
            [&]
            {
              search.from = end_of_transient(own.transient_folder.empty() ? on.folder : own.transient_folder,
                                             pair, "Limit cycle/Transient folder");
            });
      return search;
    }

    void run_limit_cycle(const AnalysisRun &on)
    {
      const LimitCycleParameters &own = on.parameters.limit_cycle;
      const PairInTime in_time = prepare_pair_in_time(on.parameters, on.bodies, on.measured);
      run_log().block("Limit cycles");
      const CycleSearch search = prepare_search(on, in_time);
      const std::vector<StabilityRoot> roots =
          search.from ? std::vector<StabilityRoot>{root_of_motion(search)}
                      : asked_roots(unstable_of(roots_of(search.scene)), own.roots);
      if (own.basins.any())
        check_basins(roots, own.basins);
      on.results.analyses["limit_cycle"] = nlohmann::ordered_json::array();
      on.results.analyses["limit_cycle_search"] = {{"friction", on.parameters.largest_friction()},
                                                   {"loss", "viscous"},
                                                   {"hub", on.parameters.hub()},
                                                   {"not_found", nlohmann::ordered_json::array()}};
      nlohmann::ordered_json &cycles = on.results.analyses["limit_cycle"],
                             &sums = on.results.analyses["limit_cycle_search"];
      if (search.from)
        sums["from_transient"] = {{"end_s", search.from->time}};
      if (!in_time.roots.is_null())
        sums["roots_beside_rail"] = in_time.roots;
      if (!in_time.wrong.empty())
        search.refuse(in_time.wrong);
      std::vector<CycleOfBasin> found;
      Progress progress("limit cycles", std::max<std::size_t>(1, roots.size()));
      for (std::size_t k = 0; k < roots.size(); ++k)
      {
        SoughtCycle sought = seek(search, roots[k]);
        const LimitCycle &cycle = sought.cycle;
        if (sought.period)
        {
          found.push_back({static_cast<unsigned int>(k + 1), sought.map->unpack(cycle.state), cycle.root,
                           cycle.period, cycle.stability && cycle.stability->is_unstable()});
          add_cycle(search, sought, k + 1, cycles);
        }
        else
          add_failure(search, cycle, sums["not_found"]);
        on.save_sometimes();
        progress.advance();
      }
      add_sums(cycles, sums);
      on_first_rank([&] { cycles_table(cycles, sums["not_found"]).write(on.folder + "/limit_cycles.csv"); });
      // another object among the results moves those that cycles and sums refer to
      if (own.basins.any())
      {
        on.save();
        run_basins(on, search.scene, search.steps, found);
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
      entries.add(
          "Limit cycle",
          "Start, Time step, Tolerance, Max Newton iterations, Multipliers, Error estimate, Harmonics");
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
