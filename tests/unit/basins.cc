// Which of two limit cycles motions go to that start between them, against the equations of their amplitudes.

#include "belt_scene.h"

#include <vibrocontact/analyses/limit_cycle/basins.h>

#include <gtest/gtest.h>

using namespace vibrocontact;

namespace
{
  /// Friction force of the velocity v: pull (v - v^3 / 3).
  constexpr double belt_of_two = 2.6, pull = 0.05;

  /// Two modes without damping that meet in the contact point, the second one with twice the modal work of a force there.
  struct TwoModesOnBelt : BeltScene
  {
    static constexpr double force = 20, omegas[] = {1, 1.7}, squares[] = {1, 2};

    TwoModesOnBelt()
        : BeltScene(
              1, 0, 1e-6, force, belt_of_two,
              [](const double speed)
              {
                const double v = belt_of_two - speed;
                return 0.3 + pull * (v - v * v * v / 3) / force;
              },
              2e-4, 26001)
    {
      pair.trace.reinit(3, 2);
      for (const unsigned int k : {0u, 1u})
        pair.trace(1, k) = std::sqrt(squares[k]);
      pair.participation.reinit(2, 3);
      pair.omega = {omegas[0], omegas[1]};
      pair.damping_ratio = {0, 0};
      pair.labels = {"mass:0", "mass:1"};
      pair.body = {1, 1};
      pair.modal_load = {0, 0};
      at_rest = initial_state(transient, contact, solver, pair, drive);
    }

    CycleOfBasin cycle_of_mode(const unsigned int k)
    {
      root.shape = {k == 0 ? 1. : 0., k == 1 ? 1. : 0.};
      root.frequency = omegas[k] / (2 * dealii::numbers::PI);
      root.growth = squares[k] * pull / 2;
      CycleMap map = BeltScene::map(200);
      const LimitCycle found = cycle(map);
      EXPECT_TRUE(found.converged) << found.message;
      EXPECT_TRUE(found.stability && found.stability->is_stable());
      // no other harmonic is in it to first order of the pull, and the velocity is 2
      return {k + 1, map.unpack(found.state), root, found.period, found.stability->decided()};
    }
  };

  /// The mode that is left, by the mean work of friction over both motions: U_k' = phi_k^2 pull / 2 (U_k - U_k^3 / 4 - U_k U_j^2 / 2).
  unsigned int winner_by_averaging(const double share)
  {
    double U[] = {2 * (1 - share), 2 * share};
    while (std::min(U[0], U[1]) > 1e-3)
    {
      constexpr double h = 1e-3;
      const double squares[] = {U[0] * U[0], U[1] * U[1]};
      for (const unsigned int k : {0u, 1u})
        U[k] += h * TwoModesOnBelt::squares[k] * U[k] * (1 - squares[k] / 4 - squares[1 - k] / 2);
    }
    return U[0] > U[1] ? 0 : 1;
  }

  double border_by_averaging()
  {
    double low = 0.01, high = 0.99;
    while (high - low > 1e-4)
      (winner_by_averaging((low + high) / 2) == 0 ? low : high) = (low + high) / 2;
    return low;
  }

  /// One start between two cycles.
  BasinParameters from_halfway(const double longest_time)
  {
    BasinParameters parameters;
    parameters.n_starts = 1;
    parameters.time_step = 0.05;
    parameters.longest_time = longest_time;
    return parameters;
  }
} // namespace

TEST(Basins, OfTwoModesMeetWhereTheEquationsOfTheirAmplitudesSay)
{
  TwoModesOnBelt scene;
  const std::vector<CycleOfBasin> cycles = {scene.cycle_of_mode(0), scene.cycle_of_mode(1)};
  BasinParameters parameters = from_halfway(1e4);
  parameters.border = 0.02;
  CycleMap window = scene.map(steps_of_window(window_of(cycles), parameters));
  BasinMarch march(window, scene.pair, scene.at_rest, cycles, parameters);
  for (const unsigned int k : {0u, 1u})
    EXPECT_NEAR(march.velocities[k], 2, 0.01);
  const BasinsBetween between = basins_between(march, {{0, 1}}, parameters);
  for (const BasinPath &path : between.paths)
  {
    std::printf("start at %.4f: %s after %.0f\n", path.share,
                path.winner ? (*path.winner ? "second" : "first") : "none", path.time.back());
    ASSERT_TRUE(path.winner) << path.message;
    EXPECT_NEAR(path.parts.back()[*path.winner], 1, 0.1);
  }
  ASSERT_EQ(between.borders.size(), 1u);
  const BasinBorder &border = between.borders.front();
  const double by_averaging = border_by_averaging();
  std::printf("border at %.4f to %.4f, by averaging %.4f\n", border.low, border.high, by_averaging);
  EXPECT_EQ(border.winners[0], 0u);
  EXPECT_EQ(border.winners[1], 1u);
  EXPECT_LE(border.high - border.low, parameters.border);
  // both velocities are 2 / sqrt(3) where neither grows
  ASSERT_EQ(border.dividing.size(), 2u);
  for (const double part : border.dividing)
    EXPECT_NEAR(part, 1 / std::sqrt(3.), 0.03);
  EXPECT_LT(border.low - 0.01, by_averaging);
  EXPECT_GT(border.high + 0.01, by_averaging);
}

TEST(Basins, AnUnstableCycleWinsNowhere)
{
  TwoModesOnBelt scene;
  std::vector<CycleOfBasin> cycles = {scene.cycle_of_mode(0), scene.cycle_of_mode(1)};
  cycles[0].is_stable = false;
  // long enough for the second one alone
  const BasinParameters parameters = from_halfway(2e3);
  CycleMap window = scene.map(steps_of_window(window_of(cycles), parameters));
  BasinMarch march(window, scene.pair, scene.at_rest, cycles, parameters);
  EXPECT_FALSE(march.follow({{0, 1}}, 0.01).winner);
  EXPECT_EQ(march.follow({{0, 1}}, 0.99).winner, 1u);
}

TEST(Basins, ACycleThatMayBeUnstableIsMarched)
{
  TwoModesOnBelt scene;
  std::vector<CycleOfBasin> cycles = {scene.cycle_of_mode(0), scene.cycle_of_mode(1)};
  cycles[0].is_stable.reset();
  BasinParameters parameters = from_halfway(2e3);
  parameters.border = 1;
  CycleMap window = scene.map(steps_of_window(window_of(cycles), parameters));
  BasinMarch march(window, scene.pair, scene.at_rest, cycles, parameters);
  const BasinsBetween between = basins_between(march, {{0, 1}}, parameters);
  // at itself, and halfway; the one that is known to be stable needs no march
  ASSERT_EQ(between.paths.size(), 2u);
  EXPECT_EQ(between.paths[0].share, 0);
  EXPECT_EQ(between.paths[1].share, 0.5);
}
