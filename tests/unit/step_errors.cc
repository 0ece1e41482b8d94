// The error that a transient estimates of itself, from a run with twice the step beside it, against its true error: the run with a
// step far below.

#include "element_scene.h"
#include "flutter.h"

#include <vibrocontact/marching/drive.h>
#include <vibrocontact/marching/initial_state.h>
#include <vibrocontact/marching/transient_march.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

using namespace vibrocontact;

namespace
{
  struct MarchedScene
  {
    std::string name;
    ContactPair pair;
    TransientParameters parameters;
    DriveFunction drive;
    double friction = 0;
    /// steps of the table and of the truth [s]
    std::vector<double> steps;
    double fine = 0;
    bool starts_follow_step = false;
    /// changes the start of run k of n_starts with this step: where the events lie between the ends of steps is chance
    std::function<void(DynamicState &, unsigned int k, double step)> start;
  };
  constexpr unsigned int n_starts = 6;

  struct Marched
  {
    double impulse = 0, rms_force = 0;
    StepErrors errors;
  };

  Marched march(const MarchedScene &scene, const double step, const bool estimate, const unsigned int k,
                const double shift)
  {
    TransientParameters parameters = scene.parameters;
    parameters.time_step = step;
    ContactParameters contact;
    contact.friction = scene.friction;
    DynamicState state = initial_state(parameters, contact, {}, scene.pair, scene.drive(0));
    scene.start(state, k, shift);
    Companion companion{scene.drive, state, {}, {}};
    const TransientResult result = transient(
        parameters, contact, {}, scene.pair, scene.drive, state,
        [](const DynamicState &, const TransientResult &) { return true; }, estimate ? &companion : nullptr);
    EXPECT_TRUE(result.converged) << result.message;
    return {result.impulse, result.rms_force(), companion.errors};
  }

  DriveFunction at_rest()
  {
    return [](double)
    {
      Drive d;
      d.creepage.speed = 0;
      return d;
    };
  }

  TransientParameters thrown(const std::string &integrator, const double theta, const std::string &reaction)
  {
    TransientParameters p;
    p.integrator = integrator;
    p.theta = theta;
    p.reaction = reaction;
    p.end_time = 1.536;
    p.initial_state = "undeformed";
    p.initial_gap = 5;
    p.initial_velocity = -10;
    return p;
  }

  /// Rms over the starts of estimated and true errors.
  /// @param below, above the estimate may be so many times less or more than the truth
  void compare(const MarchedScene &scene, const double below, const double above)
  {
    std::vector<Marched> fine(n_starts);
    for (const double step : scene.steps)
    {
      double truth[2] = {0, 0}, estimate[2] = {0, 0};
      for (unsigned int k = 0; k < n_starts; ++k)
      {
        if (scene.starts_follow_step || step == scene.steps[0])
          fine[k] = march(scene, scene.fine, false, k, step);
        const Marched one = march(scene, step, true, k, step);
        truth[0] += std::pow(one.impulse / fine[k].impulse - 1, 2);
        truth[1] += std::pow(one.rms_force / fine[k].rms_force - 1, 2);
        estimate[0] += std::pow(one.errors.impulse, 2);
        estimate[1] += std::pow(one.errors.rms_force, 2);
      }
      std::printf("| %s | %.2g |", scene.name.c_str(), step);
      for (unsigned int c = 0; c < 2; ++c)
      {
        const double ratio = std::sqrt(estimate[c] / truth[c]);
        std::printf(" %.1e | %.1e | %.2f |", std::sqrt(truth[c] / n_starts),
                    std::sqrt(estimate[c] / n_starts), ratio);
        EXPECT_GT(ratio, 1 / below) << step;
        EXPECT_LT(ratio, above) << step;
      }
      std::printf("\n");
    }
  }
} // namespace

namespace
{
  /// A bar thrown against a stop, from gaps that differ by parts of a step.
  MarchedScene thrown_bar(const std::string &name, const ContactPair &pair,
                          const TransientParameters &parameters)
  {
    return MarchedScene{name,
                        pair,
                        parameters,
                        at_rest(),
                        0,
                        {1.6e-2, 8e-3, 4e-3, 2e-3, 1e-3},
                        5e-5,
                        true,
                        [&pair](DynamicState &state, const unsigned int k, const double step)
                        {
                          for (unsigned int i = 0; i < pair.n_modes(); ++i)
                            state.q[i] += pair.participation(i, 2) * 10 * step * k / n_starts;
                        }};
  }
} // namespace

// One impact whose beginning lies anywhere in a step, and steps that do not resolve the highest modes: points open and close in
// another order in one and in two steps, so that errors that are large in one may vanish in the other.
TEST(StepErrors, BouncingBarTheta)
{
  const auto bar = bar_scene(40, 4, 20);
  compare(thrown_bar("theta 1/2", bar->pair, thrown("theta method", 0.5, "as other forces")), 10, 10);
}

TEST(StepErrors, BouncingBarExactPropagator)
{
  const auto bar = bar_scene(40, 4, 20);
  compare(thrown_bar("exact propagator", bar->pair, thrown("exact propagator", 0.5, "as other forces")), 10,
          10);
}

TEST(StepErrors, BouncingBarDamped)
{
  const auto bar = bar_scene(40, 4, 20);
  compare(thrown_bar("theta 1", bar->pair, thrown("theta method", 1, "as other forces")), 3, 3);
}

TEST(StepErrors, BouncingBarOfElements)
{
  const auto bar = bar_scene(50, 1, 20);
  compare(thrown_bar("all modes of elements, theta 1", bar->all, thrown("theta method", 1, "end of step")), 3,
          3);
}

// A mass that grows into stick-slip, from pushes of several sizes: sticking begins in another order.
TEST(StepErrors, StickSlip)
{
  MarchedScene scene;
  scene.name = "stick-slip";
  scene.pair = Flutter::pair(5e-4);
  scene.drive = Flutter::drive;
  scene.friction = Flutter::friction;
  scene.parameters.end_time = 0.0512;
  scene.start = [&](DynamicState &state, const unsigned int k, double)
  {
    for (unsigned int i = 0; i < 2; ++i)
      state.v[i] += scene.pair.trace(Flutter::lateral, i) * 0.2 * (1 + 0.1 * k);
  };
  scene.steps = {1.28e-4, 6.4e-5, 3.2e-5, 1.6e-5, 8e-6};
  scene.fine = 1e-6;
  compare(scene, 10, 10);
}

namespace
{
  /// A damped body of three modes and a residual flexibility on a sine of the height, from pushes of several sizes.
  MarchedScene on_a_sine(const std::string &name, const std::string &height)
  {
    const double pi = dealii::numbers::PI;
    MarchedScene scene;
    scene.name = name;
    ContactPair &pair = scene.pair;
    ContactGrid &grid = pair.interface.contacts.only();
    grid.n_x = grid.n_y = 1;
    grid.spacing_x = grid.spacing_y = 1;
    pair.interface.gap = {0.};
    pair.trace.reinit(3, 3);
    pair.participation.reinit(3, 3);
    pair.residual.reinit(3, 3);
    for (unsigned int k = 0; k < 3; ++k)
    {
      pair.omega.push_back((k + 0.5) * pi);
      pair.damping_ratio.push_back(0.05);
      pair.labels.push_back("bar:" + std::to_string(k));
      pair.body.push_back(1);
      pair.modal_load.push_back(0);
      pair.trace(0, k) = std::sqrt(2.) * (k % 2 == 0 ? 1 : -1);
      pair.participation(k, 2) = std::sqrt(2.) / pair.omega[k];
      pair.residual(k, k) = 0.1;
    }
    scene.parameters.end_time = 9.6;
    scene.parameters.roughness.expression = height + "*sin(2*pi*s/4)";
    RollingCase constant;
    constant.creepage = {2, 0, 0, 0};
    constant.normal_force = 0;
    constant.hub_displacement = 0.05;
    scene.drive = drive_function(scene.parameters, constant, grid);
    scene.start = [](DynamicState &state, const unsigned int k, double) { state.v[0] += 0.01 * k; };
    scene.steps = {0.05, 0.025, 0.0125, 0.00625, 0.003125};
    scene.fine = 4e-4;
    return scene;
  }
} // namespace

// No event at all, and one that comes and goes.
TEST(StepErrors, OnASine)
{
  compare(on_a_sine("on a sine", "1e-2"), 3, 3);
}

TEST(StepErrors, LeavesASine)
{
  compare(on_a_sine("leaves a sine", "0.1"), 3, 10);
}
