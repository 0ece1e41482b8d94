#include <vibrocontact/analyses/limit_cycle/balanced_cycle.h>
#include <vibrocontact/analyses/limit_cycle/basins_output.h>
#include <vibrocontact/analyses/limit_cycle/branch_output.h>
#include <vibrocontact/analyses/limit_cycle/cycle_errors.h>
#include <vibrocontact/analyses/limit_cycle/cycle_search.h>
#include <vibrocontact/analyses/limit_cycle/limit_cycle_answer.h>
#include <vibrocontact/analyses/limit_cycle/limit_cycle_output.h>
#include <vibrocontact/analyses/limit_cycle/run_basins.h>
#include <vibrocontact/analyses/limit_cycle/run_branch.h>
#include <vibrocontact/analyses/limit_cycle/run_limit_cycle.h>
#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/memory.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/marching/judge_march.h>
#include <vibrocontact/run/check_transient.h>
#include <vibrocontact/run/entries_of_contact.h>
#include <vibrocontact/run/probes_on_bodies.h>
#include <vibrocontact/run/swept_runs.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace vibrocontact
{
  namespace
  {
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

    void print(const BalancedCycle &cycle)
    {
      run_log().line("  harmonic balance, " + std::to_string(cycle.n_harmonics) + " harmonics: " +
                     (cycle.converged ? number_text(1 / cycle.period) + " Hz" : cycle.message) + ", " +
                     std::to_string(cycle.newton_iterations) + " Newton iterations, " +
                     std::to_string(cycle.n_products) + " products, " + number_text(cycle.seconds) + " s");
    }

    std::string at_frequency(const LimitCycle &cycle)
    {
      return "the cycle at " + number_text(1 / cycle.period) + " Hz";
    }

    /// Estimates the errors of the steps; a cycle with too large ones, or unknown ones, is refused: nobody chose its amplitude, as that of a
    /// march, and nothing else is known of it. @return whether it stands
    bool judge_steps(const CycleSearch &search, const SoughtCycle &sought,
                     const std::vector<unsigned int> &points, nlohmann::ordered_json &json)
    {
      const LimitCycle &cycle = sought.cycle;
      const CycleErrors errors =
          errors_of_steps(search.scene, search.own(), points, cycle, *sought.period, search.probes);
      add_errors_json(errors, json);
      if (!errors.failure.empty())
      {
        json["message"] = "what its steps change is not known";
        search.refuse("What the steps change in " + at_frequency(cycle) +
                      " is not known, since it was found in no other number of steps: " +
                      without_period(errors.failure) +
                      ". Set Limit cycle/Error estimate to false to do without.");
        return false;
      }
      const std::string said = "frequency " + percent_text(errors.frequency) + ", amplitude of " +
                               errors.signal + " " + percent_text(errors.amplitude) +
                               ", its first harmonic " + percent_text(errors.first_harmonic);
      run_log().line("  estimated error of " + std::to_string(cycle.n_steps) + " steps: " + said + ", " +
                     number_text(errors.seconds) + " s");
      const bool stands = errors.largest() <= most_step_error;
      if (!stands)
      {
        json["message"] = "its steps are too long";
        search.refuse("The steps of " + at_frequency(cycle) + " are too long: from " +
                      std::to_string(errors.n_steps) + " in a period, in place of " +
                      std::to_string(cycle.n_steps) + ", the error is estimated (" + said +
                      "). Take a shorter Limit cycle/Time step.");
      }
      return stands;
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
          search.refuse("By harmonic balance " + at_frequency(cycle) + " was not found with " +
                        std::to_string(one.n_harmonics) + " harmonics: " + without_period(one.message) + ".");
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
        const nlohmann::ordered_json branch = run_branch(search, sought, keep);
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

    /// What was asked of a cycle that was found, into the last of `cycles` and into its files. @return whether its steps are short enough
    bool add_cycle(const CycleSearch &search, SoughtCycle &sought, const std::size_t number,
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
      const bool stands = !own.error_estimate || judge_steps(search, sought, points, cycles.back());
      cycles.back()["converged"] = stands;
      if (stands && own.n_multipliers > 0 && !sought.cycle.not_judged.empty())
        search.refuse("The stability of " + at_frequency(sought.cycle) +
                      " is not known: " + sought.cycle.not_judged +
                      ". Set Limit cycle/Multipliers to 0 to do without, or march in time from near it.");
      if (!own.harmonics.empty())
      {
        add_balance(search, sought, by_steps, cycles.back());
        on_first_rank([&] { balance_table(cycles).write(on.folder + "/limit_cycle_harmonic_balance.csv"); });
      }
      if (own.branch.any() && stands)
      {
        add_branch(search, sought, cycles.back());
        if (cycles.back().contains("branch"))
          on_first_rank([&] { branch_table(cycles).write(on.folder + "/limit_cycle_branch.csv"); });
      }
      return stands;
    }

    /// Lists a cycle that was found before, from another root; nothing else is asked of it.
    void add_repeated(const SoughtCycle &sought, const std::size_t number, const unsigned int first,
                      const unsigned int n_multipliers, nlohmann::ordered_json &cycles)
    {
      nlohmann::ordered_json again = cycle_json(sought.cycle, *sought.period, n_multipliers);
      again["number"] = number;
      again["same_as"] = first;
      again["converged"] = true;
      run_log().line("  the same as cycle " + std::to_string(first) + ", from another root");
      cycles.push_back(again);
    }

    /// Lists a root from which no cycle was found.
    void add_failure(const CycleSearch &search, const LimitCycle &cycle, nlohmann::ordered_json &not_found)
    {
      not_found.push_back(failed_json(cycle));
      search.refuse("No limit cycle was found from the " +
                    std::string(cycle.motion.empty() ? "" : cycle.motion + ", near the ") + "root at " +
                    number_text(cycle.root.frequency) + " Hz: " + without_period(cycle.message) +
                    (cycle.motion.empty() ? "" : advice_for_motion(cycle.root)) + ".");
    }

    void run_limit_cycle(const AnalysisRun &on)
    {
      const LimitCycleParameters &own = on.parameters.limit_cycle;
      const PairInTime in_time = prepare_pair_in_time(on.parameters, on.bodies, on.measured);
      run_log().block("Limit cycles");
      const CycleSearch search = prepare_search(on, in_time);
      const std::vector<StabilityRoot> roots = roots_to_begin_from(search);
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
      // those that stand and differ from each other, and one period of each
      std::vector<CycleOfBasin> found;
      std::vector<CyclePeriod> periods;
      // what the machine has too little memory for
      std::string shortage;
      Progress progress("limit cycles", std::max<std::size_t>(1, roots.size()));
      for (std::size_t k = 0; k < roots.size(); ++k)
      {
        SoughtCycle sought = seek_cycle(search, roots[k], progress);
        const LimitCycle &cycle = sought.cycle;
        const auto same = std::find_if(periods.begin(), periods.end(),
                                       [&](const CyclePeriod &one)
                                       { return sought.period && one.is_same(*sought.period); });
        if (same != periods.end())
          add_repeated(sought, k + 1, found[same - periods.begin()].number, own.n_multipliers, cycles);
        else if (sought.period)
        {
          const CycleOfBasin reached = {static_cast<unsigned int>(k + 1), sought.map->unpack(cycle.state),
                                        cycle.root, cycle.period,
                                        cycle.stability ? cycle.stability->decided() : std::nullopt};
          if (add_cycle(search, sought, k + 1, cycles))
          {
            found.push_back(reached);
            periods.push_back(*sought.period);
          }
        }
        else
        {
          if (sought.lacks_memory)
            shortage = cycle.message;
          add_failure(search, cycle, sums["not_found"]);
        }
        on.save_sometimes();
        progress.advance();
      }
      add_sums(cycles, sums);
      on_first_rank([&] { cycles_table(cycles, sums["not_found"]).write(on.folder + "/limit_cycles.csv"); });
      if (!shortage.empty())
        throw MachineError(shortage);
      // another object among the results moves those that cycles and sums refer to
      if (own.basins.any())
      {
        on.save();
        run_basins(search, found);
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
                        {"loudest_largest_growth_1_s", "/limit_cycle_search/loudest/largest_growth_1_s"},
                        {"loudest_estimated_error_amplitude",
                         "/limit_cycle_search/loudest/estimated_error_amplitude"}}),
            nullptr,
            [](const Parameters &parameters) -> std::string
            {
              const LimitCycleParameters &own = parameters.limit_cycle;
              return own.starts_from_transient() && own.transient_folder.empty() ? "transient" : "";
            }};
  }
} // namespace vibrocontact
