#include <vibrocontact/analyses/limit_cycle/branch_output.h>
#include <vibrocontact/analyses/limit_cycle/limit_cycle_output.h>
#include <vibrocontact/analyses/limit_cycle/run_branch.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace vibrocontact
{
  namespace
  {
    /// over the range of a branch: where the growth of the root is looked at beside the onset, how far off its zero may be, and how
    /// well it is found
    constexpr double first_secant = 2e-3, near_onset = 0.05, root_tolerance = 1e-7;
    /// of the growth at the value of the file: what a root grows by at its onset is no more
    constexpr double growth_at_onset = 0.05;
    constexpr unsigned int most_secants = 20;
    /// difference of the frequencies of two roots that flutter together, over the frequency
    constexpr double one_frequency = 1e-4;

    /// The scene with the entry at a value. @param points that may touch
    std::shared_ptr<CycleAt> cycle_at(const CycleSearch &search, const std::vector<unsigned int> &points,
                                      const unsigned int n_steps, const double value)
    {
      const ContactSections &contacts = search.on.parameters.contacts;
      const CycleBranchParameters &branch = search.own().branch;
      RollingCase constants = search.constants;
      branch.value_in(constants) = value;
      const auto at = std::make_shared<CycleAt>();
      try
      {
        at->scene = cycle_scene(search.on.parameters, search.held,
                                branch.is_friction() ? contacts.with_friction(value) : contacts, constants,
                                &search.scene);
      }
      catch (const InputError &error)
      {
        throw ConvergenceError(error.what());
      }
      at->map = map_about(at->scene, points, n_steps);
      at->map->left_its_points = !at->map->are_known(at->scene.at_rest.R);
      at->equilibrium = at->map->pack(at->scene.at_rest);
      return at;
    }

    /// Growth of the root that goes on from a free mode, the nearest to a frequency if there are several; of two that flutter
    /// together, at one frequency, that of the one that grows.
    double growth_of(const CycleScene &scene, const std::string &label, const double frequency)
    {
      std::vector<StabilityRoot> roots = roots_of(scene);
      roots.erase(std::remove_if(roots.begin(), roots.end(),
                                 [&](const StabilityRoot &root) { return root.label != label; }),
                  roots.end());
      if (roots.empty())
        throw ConvergenceError("no root belongs to " + label);
      const auto distance = [](const StabilityRoot &root, const double from)
      { return std::abs(root.frequency - from); };
      const StabilityRoot nearest =
          *std::min_element(roots.begin(), roots.end(),
                            [&](const StabilityRoot &a, const StabilityRoot &b)
                            { return distance(a, frequency) < distance(b, frequency); });
      double growth = nearest.growth;
      for (const StabilityRoot &root : roots)
        if (distance(root, nearest.frequency) < one_frequency * frequency)
          growth = std::max(growth, root.growth);
      return growth;
    }

    /// How the root grows at an onset, and, if it is close, where its growth is zero, by the secant method.
    /// @param range of the branch, from the onset inwards
    void compare_with_root(const CycleFamily &family, const LimitCycle &cycle, const double range,
                           nlohmann::ordered_json &end)
    {
      const double onset = end["onset"];
      double before = onset, value = onset + first_secant * range,
             growth_before = growth_of(family(onset)->scene, cycle.root.label, 1 / cycle.period);
      end["root_growth_1_s"] = growth_before;
      if (std::abs(growth_before) > growth_at_onset * std::abs(cycle.root.growth))
        return;
      for (unsigned int k = 0; k < most_secants && std::abs(value - onset) < near_onset * std::abs(range);
           ++k)
      {
        const double growth = growth_of(family(value)->scene, cycle.root.label, 1 / cycle.period),
                     next = value - growth * (value - before) / (growth - growth_before);
        if (std::abs(next - value) < root_tolerance * std::abs(range))
        {
          end["onset_of_root"] = next;
          return;
        }
        before = value;
        growth_before = growth;
        value = next;
      }
    }
  } // namespace

  nlohmann::ordered_json
  run_branch(const CycleSearch &search, const SoughtCycle &from,
             const std::function<void(const std::vector<nlohmann::ordered_json> &)> &keep)
  {
    const LimitCycleParameters &own = search.own();
    const LimitCycle &start = from.cycle;
    RollingCase constants = search.constants;
    const double value = own.branch.value_in(constants), range = own.branch.to() - own.branch.from();
    Log &log = run_log();
    log.line("  followed over " + own.branch.entry + " from " + number_text(value) + " both ways:");
    std::vector<nlohmann::ordered_json> heard;
    const auto hear = [&](const CycleBranchPoint &point, CycleAt &at)
    {
      try
      {
        const CyclePeriod period =
            listen_to_cycle(*at.map, point.cycle, *at.scene.pair, at.scene.contacts, search.probes);
        heard.push_back(cycle_json(point.cycle, period, own.n_multipliers));
        heard.back()["value"] = point.value;
      }
      catch (const InputError &error)
      {
        throw ConvergenceError(error.what());
      }
      log.line("    " + number_text(point.value) + ": " + number_text(1 / point.cycle.period) + " Hz" +
               (point.sticks ? "" : ", nothing sticks") + ", " +
               std::to_string(point.cycle.newton_iterations) + " Newton iterations, " +
               number_text(point.cycle.seconds + point.cycle.stability_seconds) + " s");
      keep(heard);
    };
    const auto points_of = [&](const unsigned int k) {
      return points_around(search.pair().interface.contacts, search.scene.at_rest.R, spreads_of_contact[k]);
    };
    const auto map_of = [&](const std::vector<unsigned int> &points)
    { return map_about(search.scene, points, start.n_steps); };
    std::vector<unsigned int> grid_points = points_of(from.spread);
    const CycleFamily family = [&](const double at)
    { return cycle_at(search, grid_points, start.n_steps, at); };
    LimitCycle first = start;
    CycleBranch branch = follow_cycle(family, first, value, own, hear);
    for (unsigned int k = from.spread + 1; k < std::size(spreads_of_contact); ++k)
    {
      if (!branch.ends[0].left_its_points && !branch.ends[1].left_its_points)
        break;
      log.line("    the contact reaches farther than at rest: once more with more points");
      const DynamicState state = map_of(grid_points)->unpack(first.state);
      grid_points = points_of(k);
      first.state = map_of(grid_points)->pack(state);
      heard.clear();
      branch = follow_cycle(family, first, value, own, hear);
    }
    std::vector<nlohmann::ordered_json> points;
    for (const CycleBranchPoint &point : branch.points)
      points.push_back(heard.at(point.number));
    nlohmann::ordered_json json = branch_json(own.branch.entry, branch, points);
    for (const unsigned int k : {0u, 1u})
      if (branch.ends[k].kind == CycleBranchEnd::Kind::vanishes)
        try
        {
          const bool at_begin = k == 0;
          compare_with_root(family, (at_begin ? branch.points.front() : branch.points.back()).cycle,
                            at_begin ? range : -range, json[at_begin ? "begin" : "end"]);
        }
        catch (const std::runtime_error &error)
        {
          log.line(std::string("    the root at the onset was not found: ") + error.what());
        }
    return json;
  }
} // namespace vibrocontact
