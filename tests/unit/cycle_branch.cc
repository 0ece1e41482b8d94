// Limit cycles followed over a parameter: onsets in closed form, cycles found from roots on the way.

#include "belt_scene.h"
#include "flutter.h"

#include <vibrocontact/analyses/limit_cycle/cycle_branch.h>

#include <gtest/gtest.h>

#include <functional>

using namespace vibrocontact;

namespace
{
  LimitCycleParameters followed(const double from, const double to)
  {
    LimitCycleParameters parameters;
    parameters.branch.entry = "Contact/Friction coefficient";
    parameters.branch.range = {from, to};
    return parameters;
  }

  /// Cycles of a scene that a value changes; keeps the scenes, which maps refer to.
  class BeltFamily
  {
  public:
    BeltFamily(const BeltScene &first, const unsigned int n_steps,
               const std::function<void(BeltScene &, double)> &set)
        : first(first), n_steps(n_steps), set(set)
    {
    }

    std::shared_ptr<CycleAt> operator()(const double value)
    {
      scenes.push_back(std::make_unique<BeltScene>(first));
      BeltScene &scene = *scenes.back();
      set(scene, value);
      const auto at = std::make_shared<CycleAt>();
      at->scene.at_rest = scene.at_rest;
      at->map = std::make_unique<CycleMap>(scene.map(n_steps));
      at->equilibrium = at->map->pack(scene.at_rest);
      return at;
    }

  private:
    const BeltScene &first;
    const unsigned int n_steps;
    const std::function<void(BeltScene &, double)> set;
    std::vector<std::unique_ptr<BeltScene>> scenes;
  };

  void print(const CycleBranch &branch)
  {
    for (const CycleBranchPoint &point : branch.points)
      std::printf("%.6f: %.6f s, %u iterations%s%s\n", point.value, point.cycle.period,
                  point.cycle.newton_iterations, point.sticks ? ", sticks" : "",
                  point.cycle.stability ? (", " + point.cycle.stability->verdict()).c_str() : "");
  }
} // namespace

// Friction falls with the slip speed between 1.6 and 3.6 m/s alone, as v - v^3 / 3 of v = 2.6 - s: a mass without damping oscillates on
// belts of these speeds, with an amplitude that vanishes at both.
TEST(CycleBranch, BeginsAndEndsWhereFrictionStopsFalling)
{
  constexpr double force = 20, belt = 2.6;
  const auto friction = [](const double speed)
  {
    const double v = 2.6 - speed;
    return 0.4 + (v - v * v * v / 3) / force;
  };
  constexpr unsigned int n_steps = 400;
  const BeltScene first(1, 0, 1e-6, force, belt, friction, 1e-3, 7000);
  BeltFamily scenes(first, n_steps, [](BeltScene &scene, const double speed) { scene.run_at(speed, 0); });
  const CycleFamily family = std::ref(scenes);
  CycleMap map = first.map(n_steps);
  const LimitCycle start = first.cycle(map);
  ASSERT_TRUE(start.converged) << start.message;
  const CycleBranch branch =
      follow_cycle(family, start, belt, followed(1, 4.5), [](const CycleBranchPoint &, CycleAt &) {});
  print(branch);
  const double onsets[] = {1.6, 3.6};
  for (const unsigned int k : {0u, 1u})
  {
    ASSERT_EQ(branch.ends[k].kind, CycleBranchEnd::Kind::vanishes) << branch.ends[k].reason;
    const LimitCycle &last = (k == 0 ? branch.points.front() : branch.points.back()).cycle;
    std::printf("onset %.9f, period over 2 pi %.9f\n", branch.ends[k].onset,
                last.period / (2 * dealii::numbers::PI));
    EXPECT_NEAR(branch.ends[k].onset, onsets[k], 1e-4);
    EXPECT_NEAR(last.period / (2 * dealii::numbers::PI), 1, 1e-3);
  }
  EXPECT_TRUE(branch.folds.empty());
  for (const CycleBranchPoint &point : branch.points)
  {
    EXPECT_FALSE(point.sticks);
    EXPECT_EQ(point.cycle.stability->verdict(), "stable") << point.value;
  }
}

// Friction mu0 + e (a v + b v^3 - d v^5) of v = belt - s under a force N, against a damper: averaging over a cycle of amplitude A
// leaves N e (a + 3/4 b A^2 - 5/8 d A^4) = 2 zeta. Cycles begin at N = 2 zeta / (e a), become larger while N falls, and turn round at
// A^2 = 3/5 b / d: two cycles, one of them stable, between the two forces.
TEST(CycleBranch, TurnsRoundAtAFold)
{
  constexpr double belt = 1.6, e = 0.05, a = 0.1, b = 1, d = 1, flexibility = 1e-6, zeta = e * a / 2;
  const auto friction = [](const double speed)
  {
    const double v = belt - speed, square = v * v;
    return 0.5 + e * v * (a + b * square - d * square * square);
  };
  const double fold = a / (a + 0.225 * b * b / d);
  constexpr unsigned int n_steps = 200;
  const double begin = 1.3;
  const BeltScene first(1, zeta, flexibility, begin, belt, friction, 1e-3, 3200);
  BeltFamily scenes(first, n_steps,
                    [](BeltScene &scene, const double force)
                    {
                      scene.drive.approach = force * flexibility;
                      scene.run_at(belt, 0);
                    });
  const CycleFamily family = std::ref(scenes);
  CycleMap map = first.map(n_steps);
  const LimitCycle start = first.cycle(map);
  ASSERT_TRUE(start.converged) << start.message;
  const LimitCycleParameters parameters = followed(0.1, 1.5);
  const CycleBranch branch =
      follow_cycle(family, start, begin, parameters, [](const CycleBranchPoint &, CycleAt &) {});
  print(branch);
  ASSERT_EQ(branch.ends[0].kind, CycleBranchEnd::Kind::vanishes) << branch.ends[0].reason;
  ASSERT_EQ(branch.ends[1].kind, CycleBranchEnd::Kind::range) << branch.ends[1].reason;
  ASSERT_EQ(branch.folds.size(), 1u);
  std::printf("fold at %.6f (averaging %.6f), onset at %.6f (1)\n", branch.folds[0], fold,
              branch.ends[0].onset);
  EXPECT_NEAR(branch.folds[0] / fold, 1, 5e-3);
  EXPECT_NEAR(branch.ends[0].onset, 1, 1e-3);
  // unstable from the onset to the fold, stable beyond
  bool beyond = false;
  for (std::size_t k = 0; k < branch.points.size(); ++k)
  {
    beyond = beyond || (k > 0 && branch.points[k].value > branch.points[k - 1].value);
    if (std::abs(branch.points[k].value - fold) > 0.02)
      EXPECT_EQ(branch.points[k].cycle.stability->verdict(), beyond ? "stable" : "fold")
          << branch.points[k].value;
    EXPECT_GE(branch.points[k].value, 0.1);
    EXPECT_LE(branch.points[k].value, 1.5);
  }
  // no more points than are asked for, which is said
  LimitCycleParameters few = parameters;
  few.branch.most_points = 3;
  const CycleBranch part =
      follow_cycle(family, start, begin, few, [](const CycleBranchPoint &, CycleAt &) {});
  EXPECT_EQ(part.ends[0].kind, CycleBranchEnd::Kind::most_points);
  EXPECT_NE(part.ends[0].reason.find("Most points"), std::string::npos);
}

// A mass in flutter over its friction: the growth of its root is zero at the onset, and cycles found from the root lie on the branch.
TEST(CycleBranch, OfFlutterHasTheCyclesOfItsRootsAndBeginsWhereTheyGrow)
{
  constexpr unsigned int n_steps = 200;
  const TransientParameters transient = []
  {
    TransientParameters steps;
    steps.integrator = "exact propagator";
    return steps;
  }();
  const ContactSolverParameters solver = solver_of_cycles({});
  const auto pair = std::make_shared<const ContactPair>(Flutter::pair(5e-4));
  const Drive drive = Flutter::drive(0);
  const CycleFamily family = [&](const double friction)
  {
    const auto at = std::make_shared<CycleAt>();
    at->scene.steps = transient;
    at->scene.solver = solver;
    at->scene.contacts.first().friction = friction;
    at->scene.pair = pair;
    at->scene.drive = drive;
    at->scene.at_rest = initial_state(transient, at->scene.contacts, solver, *pair, drive);
    at->map = map_about(at->scene, {Flutter::middle}, n_steps);
    at->equilibrium = at->map->pack(at->scene.at_rest);
    return at;
  };
  const auto growing = [&](CycleAt &at)
  {
    const std::vector<StabilityRoot> roots = roots_of(at.scene);
    return *std::max_element(roots.begin(), roots.end(),
                             [](const auto &a, const auto &b) { return a.growth < b.growth; });
  };
  const auto cycle_at = [&](const double friction, const LimitCycleParameters &parameters)
  {
    const std::shared_ptr<CycleAt> at = family(friction);
    return find_limit_cycle(*at->map, *pair, at->scene.at_rest, growing(*at), parameters);
  };
  const LimitCycleParameters parameters = followed(1e-3, 0.6);
  const LimitCycle start = cycle_at(Flutter::friction, parameters);
  ASSERT_TRUE(start.converged) << start.message;
  const CycleBranch branch =
      follow_cycle(family, start, Flutter::friction, parameters, [](const CycleBranchPoint &, CycleAt &) {});
  print(branch);
  ASSERT_EQ(branch.ends[0].kind, CycleBranchEnd::Kind::vanishes) << branch.ends[0].reason;
  ASSERT_EQ(branch.ends[1].kind, CycleBranchEnd::Kind::range) << branch.ends[1].reason;
  // the march damps a little more than the equations that the roots are of
  const double growth = growing(*family(branch.ends[0].onset)).growth,
               beside = growing(*family(branch.ends[0].onset + 1e-4)).growth;
  std::printf("onset %.6f, by the roots %.6f\n", branch.ends[0].onset,
              branch.ends[0].onset - growth * 1e-4 / (beside - growth));
  EXPECT_NEAR(growth * 1e-4 / (beside - growth), 0, 1e-5);
  // another cycle from its root
  const CycleBranchPoint &between = branch.points[branch.points.size() - 3];
  const LimitCycle alone = cycle_at(between.value, parameters);
  ASSERT_TRUE(alone.converged) << alone.message;
  std::printf("period at %.6f off by %.1e\n", between.value, between.cycle.period / alone.period - 1);
  EXPECT_NEAR(between.cycle.period / alone.period, 1, 1e-6);
}
