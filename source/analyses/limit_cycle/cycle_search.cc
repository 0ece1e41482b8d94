#include <vibrocontact/analyses/limit_cycle/cycle_search.h>
#include <vibrocontact/analyses/limit_cycle/cycle_start.h>
#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/marching/transient_checkpoint.h>
#include <vibrocontact/output/verdict.h>
#include <vibrocontact/run/check_transient.h>
#include <vibrocontact/run/probes_on_bodies.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

namespace vibrocontact
{
  namespace
  {
    /// of the frequencies in Limit cycle/Roots
    constexpr double same_frequency = 1e-2;

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
    StabilityRoot root_of_motion(const CycleSearch &search)
    {
      const CycleScene &scene = search.scene;
      const std::vector<unsigned int> points =
          points_around(scene.pair->interface.contacts, scene.at_rest.R, *std::begin(spreads_of_contact));
      const auto one_step = map_about(scene, points, 1, search.on.parameters.contact_solver);
      const std::vector<StabilityRoot> all = roots_of(scene), unstable = unstable_of(all);
      return nearest_root(*one_step, *scene.pair, scene.at_rest, unstable.empty() ? all : unstable,
                          *search.from);
    }

    void find_on_enough_points(const CycleSearch &search, const StabilityRoot &root,
                               const unsigned int n_steps, Progress &progress, SoughtCycle &sought)
    {
      const DynamicState &at_rest = search.scene.at_rest;
      for (sought.spread = 0;; ++sought.spread)
      {
        const std::vector<unsigned int> points =
            points_around(search.pair().interface.contacts, at_rest.R, spreads_of_contact[sought.spread]);
        sought.map = map_about(search.scene, points, n_steps);
        sought.map->progress = &progress;
        sought.cycle = find_limit_cycle(*sought.map, search.pair(), at_rest, root, search.own(),
                                        search.from ? &*search.from : nullptr);
        if (sought.cycle.converged || !sought.map->left_its_points ||
            sought.spread + 1 == std::size(spreads_of_contact))
          return;
      }
    }

    void say(const LimitCycle &cycle)
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
  } // namespace

  void CycleSearch::refuse(const std::string &sentence) const
  {
    vibrocontact::refuse(sentence, on.results);
  }

  CycleSearch prepare_search(const AnalysisRun &on, const PairInTime &in_time)
  {
    const Parameters &parameters = on.parameters;
    const auto held = std::make_shared<const ContactPair>(
        contact_pair(in_time.prepared->bodies, parameters.contacts, parameters.placed_contacts()));
    const RollingCase constants = rolling_cases(parameters.rolling, parameters.contacts).front();
    CycleSearch search = {on,
                          held,
                          constants,
                          cycle_scene(parameters, held, parameters.contacts, constants),
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

  std::vector<StabilityRoot> roots_to_begin_from(const CycleSearch &search)
  {
    if (search.from)
      return {root_of_motion(search)};
    std::vector<StabilityRoot> roots = asked_roots(unstable_of(roots_of(search.scene)), search.own().roots);
    const double reach = search.pair().modes_reach;
    const auto beyond = std::stable_partition(
        roots.begin(), roots.end(), [reach](const StabilityRoot &root) { return root.frequency <= reach; });
    const auto n = roots.end() - beyond;
    if (n == 0)
      return roots;
    const bool asked = !search.own().roots.empty();
    doubt(std::string(asked ? "Cycles are" : "No cycle is") + " sought from " + std::to_string(n) +
              (n == 1 ? " root" : " roots") + " above " + number_text(reach) +
              " Hz, the highest of the modes kept, which do not carry " + (n == 1 ? "it" : "them") +
              ": keep more modes" + (asked ? "." : ", or name it in Limit cycle/Roots."),
          search.on.results);
    if (!asked)
      roots.erase(beyond, roots.end());
    return roots;
  }

  SoughtCycle seek_cycle(const CycleSearch &search, const StabilityRoot &root, Progress &progress)
  {
    const ContactPair &pair = search.pair();
    const unsigned int n_steps = steps_of_period(root, search.own());
    SoughtCycle sought;
    LimitCycle &cycle = sought.cycle;
    cycle.root = root;
    cycle.n_steps = n_steps;
    cycle.message = shortage_of_derivatives(search.scene, n_steps);
    sought.lacks_memory = !cycle.message.empty();
    if (!sought.lacks_memory)
      find_on_enough_points(search, root, n_steps, progress, sought);
    if (search.from)
      cycle.motion = search.own().name_of_start();
    if (cycle.converged)
      try
      {
        sought.period = listen_to_cycle(*sought.map, cycle, pair, search.scene.contacts, search.probes);
      }
      catch (const std::runtime_error &error)
      {
        cycle.converged = false;
        cycle.message = error.what();
      }
    say(cycle);
    return sought;
  }
} // namespace vibrocontact
