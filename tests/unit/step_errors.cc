// The error that a transient estimates of itself, from a run with twice the step beside it, against its true error: the run with a
// step far below.

#include "element_scene.h"
#include "flutter.h"

#include <vibrocontact/analyses/transient.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

using namespace vibrocontact;

namespace
{
  struct Scene
  {
    std::string name;
    ContactPair pair;
    TransientParameters parameters;
    DriveFunction drive;
    double friction = 0;
    /// steps of the table and of the truth [s]
    std::vector<double> steps;
    double fine = 0;
    /// changes the start of the run
    std::function<void(DynamicState &)> push = [](DynamicState &) {};
  };

  struct Marched
  {
    double impulse = 0, rms_force = 0;
    StepErrors errors;
  };

  Marched march(const Scene &scene, const double step, const bool estimate)
  {
    TransientParameters parameters = scene.parameters;
    parameters.time_step = step;
    ContactParameters contact;
    contact.friction = scene.friction;
    DynamicState state = initial_state(parameters, contact, {}, scene.pair, scene.drive(0));
    scene.push(state);
    Companion companion{scene.drive, {}};
    companion.run.state = state;
    const TransientResult result = transient(
        parameters, contact, {}, scene.pair, scene.drive, state,
        [](const DynamicState &, const TransientResult &) { return true; }, {},
        estimate ? &companion : nullptr);
    EXPECT_TRUE(result.converged) << result.message;
    return {result.impulse, result.rms_force(), companion.run.errors};
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

  /// @param within factor between estimate and truth
  void compare(const Scene &scene, const double within)
  {
    const Marched truth = march(scene, scene.fine, false);
    for (const double step : scene.steps)
    {
      const Marched one = march(scene, step, true);
      const double impulse = std::abs(one.impulse / truth.impulse - 1),
                   rms = std::abs(one.rms_force / truth.rms_force - 1);
      std::printf("| %s | %.2g | %.1e | %.1e | %.2f | %.1e | %.1e | %.2f |\n", scene.name.c_str(), step,
                  impulse, one.errors.impulse, one.errors.impulse / impulse, rms, one.errors.rms_force,
                  one.errors.rms_force / rms);
      EXPECT_GT(one.errors.largest(), std::max(impulse, rms) / within) << step;
      EXPECT_LT(one.errors.largest(), std::max(impulse, rms) * within) << step;
    }
  }
} // namespace

TEST(StepErrors, BouncingBar)
{
  const auto bar = bar_scene(40, 4, 20);
  const std::vector<double> steps = {1.6e-2, 8e-3, 4e-3, 2e-3, 1e-3};
  compare({"theta 1/2", bar->pair, thrown("theta method", 0.5, "as other forces"), at_rest(), 0, steps, 2e-5},
          10);
  compare({"theta 1", bar->pair, thrown("theta method", 1, "as other forces"), at_rest(), 0, steps, 2e-5}, 3);
  compare({"exact propagator", bar->pair, thrown("exact propagator", 0.5, "as other forces"), at_rest(), 0,
           steps, 2e-5},
          10);
  const auto elements = bar_scene(50, 1, 20);
  compare({"elements, theta 1", elements->all, thrown("theta method", 1, "end of step"), at_rest(), 0, steps,
           2e-5},
          3);
}

TEST(StepErrors, StickSlip)
{
  Scene scene;
  scene.name = "flutter";
  scene.pair = Flutter::pair(5e-4);
  scene.drive = Flutter::drive;
  scene.friction = Flutter::friction;
  scene.parameters.end_time = 0.0512;
  scene.push = [&](DynamicState &state)
  {
    for (unsigned int k = 0; k < 2; ++k)
      state.v[k] += scene.pair.modal_trace(Flutter::lateral, k) * 0.2;
  };
  scene.steps = {1.28e-4, 6.4e-5, 3.2e-5, 1.6e-5, 8e-6};
  scene.fine = 5e-7;
  compare(scene, 10);
}
