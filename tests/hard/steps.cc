// Steps in time at their limits: millions of impacts, steps from 1e-12 s to 1e-2 s, impulses, gaps of 1e-15 m, resonance
// without damping, modes from 1 Hz to 1 GHz.

#include "../unit/pi.h"
#include "report.h"

#include <vibrocontact/marching/initial_state.h>
#include <vibrocontact/marching/transient_march.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

using namespace vibrocontact;

namespace
{
  /// Modes that move one contact point along its normal, on a contact without mass of a compliance.
  ContactPair point(const std::vector<double> &omega, const double mass, const double compliance)
  {
    ContactPair pair;
    ContactGrid &grid = pair.interface.contacts.only();
    grid.n_x = grid.n_y = 1;
    grid.spacing_x = grid.spacing_y = 1e-3;
    pair.interface.gap = {0.};
    pair.omega = omega;
    pair.damping_ratio.assign(omega.size(), 0.);
    pair.modal_load.assign(omega.size(), 0.);
    pair.body.assign(omega.size(), 1);
    pair.trace.reinit(3, omega.size());
    pair.participation.reinit(omega.size(), 3);
    for (unsigned int k = 0; k < omega.size(); ++k)
    {
      pair.labels.push_back("mass:" + std::to_string(k));
      pair.trace(0, k) = 1 / std::sqrt(mass);
      pair.participation(k, 2) = std::sqrt(mass);
    }
    pair.residual.reinit(3, 3);
    for (unsigned int i = 0; i < 3; ++i)
      pair.residual(i, i) = compliance;
    return pair;
  }

  struct PointRun
  {
    double step = 1e-5;
    unsigned long steps = 1000;
    double gap = 0, displacement = 0, velocity = 0, mass = 1;
    std::string integrator = "theta method";
    /// force on the mass along z over time
    std::function<double(double)> force = [](double) { return 0.; };
    /// what came of it
    DynamicState state;
    TransientResult result;
    unsigned long impacts = 0;
    double most_energy = 0, deepest = 0, largest_force = 0;

    void march(const ContactPair &pair)
    {
      TransientParameters p;
      p.time_step = step;
      p.end_time = step * steps;
      p.integrator = integrator;
      p.error_estimate = false;
      p.initial_state = "undeformed";
      ContactParameters contact;
      contact.friction = 0;
      const ContactSolverParameters solver;
      const DriveFunction drive = [&](const double t)
      {
        Drive d;
        d.creepage.speed = 0;
        d.force = force(t);
        d.gap = {gap};
        return d;
      };
      state = initial_state(p, contact, solver, pair, drive(0));
      for (unsigned int k = 0; k < pair.n_modes(); ++k)
      {
        state.q[k] = displacement * std::sqrt(mass);
        state.v[k] = velocity * std::sqrt(mass);
      }
      bool closed = false;
      result = transient(p, contact, solver, pair, drive, state,
                         [&](const DynamicState &s, const TransientResult &r)
                         {
                           impacts += s.R[0] > 0 && !closed;
                           closed = s.R[0] > 0;
                           most_energy = std::max(most_energy, r.energy.stored);
                           largest_force = std::max(largest_force, s.R[0]);
                           return true;
                         });
      deepest = -result.smallest_gap;
      EXPECT_TRUE(result.converged) << result.message;
    }
    double z() const { return state.q[0] / std::sqrt(mass); }
    double rate() const { return state.v[0] / std::sqrt(mass); }
  };
} // namespace

// 1 kg on a spring strikes a stop of 1e-6 m/N beside it, over and over, theta 1/2, no damping: what is stored stays, the account
// stays closed, the stop is never penetrated. VIBROCONTACT_HARD_STEPS=1e7 makes that many steps.
TEST(HardSteps, ThetaOneHalfOverManyImpacts)
{
  const char *const asked = std::getenv("VIBROCONTACT_HARD_STEPS");
  PointRun run;
  run.steps = asked ? std::strtod(asked, nullptr) : 3e5;
  run.step = 1e-5;
  run.gap = 1e-3;
  run.velocity = -2.;
  run.march(point({2 * pi * 100}, run.mass, 1e-6));
  const double before = run.result.energy.initial;
  EXPECT_GT(run.impacts, run.steps / 1500);
  // each impact of 300 steps leaves a millionth, to either side
  EXPECT_NEAR(run.most_energy / before, 1, 1e-4 * std::max(1., run.steps / 3e5));
  EXPECT_NEAR(run.result.energy.stored / before, 1, 1e-4 * std::max(1., run.steps / 3e5));
  EXPECT_LE(std::abs(run.result.energy.imbalance()), 1e-4 * before * std::max(1., run.steps / 3e5));
  EXPECT_LE(run.deepest, 1e-15);
  std::printf("%lu steps, %lu impacts, %.3g s\n", run.result.steps, run.impacts, run.result.seconds);
  report("most energy over the first", run.most_energy / before - 1);
  report("last energy over the first", run.result.energy.stored / before - 1);
  report("imbalance", run.result.energy.imbalance() / before);
}

// A load that begins at once on a mass on its contact spring, w = 1e4 1/s: z = -depth (1 - cos w t), in steps from 1e-12 s on.
TEST(HardSteps, StepsFromPicoseconds)
{
  const double load = 100, compliance = 1e-8, w = 1e4, depth = load * compliance;
  for (const std::string integrator : {"theta method", "exact propagator"})
    for (const double step : {1e-12, 1e-9, 1e-7, 1e-6})
    {
      PointRun run;
      run.step = step;
      run.integrator = integrator;
      run.force = [=](double) { return -load; };
      run.march(point({0}, run.mass, compliance));
      const double truth = -depth * 2 * std::pow(std::sin(0.5 * w * step * run.steps), 2);
      const double error = std::abs(run.z() - truth) / std::min(depth, std::abs(truth));
      EXPECT_LE(error, 1e-5 + 10 * std::pow(w * step, 2) + 0.4 * (w * step)) << integrator << " " << step;
      report(step == 1e-12 ? "after 1000 steps of 1e-12 s" : "of a longer one", error);
    }
}

// A mass thrown against a contact whose period is 6e-4 s: steps from 1e-5 s converge to a rebound that keeps its energy, in second
// order; longer steps than that period give energy without end, which the account tells (the run ends with exit code 2).
TEST(HardSteps, StepsOfAHundredth)
{
  for (const std::string integrator : {"theta method", "exact propagator"})
  {
    double before = 0;
    for (const double step : {1e-5, 1e-6, 1e-3, 1e-2})
    {
      PointRun run;
      run.step = step;
      run.steps = step < 1e-5 ? 3000 : 1000;
      run.integrator = integrator;
      run.gap = 1e-3;
      run.velocity = -1;
      run.march(point({2 * pi}, run.mass, 1e-8));
      const double gained = run.result.energy.stored / run.result.energy.initial - 1,
                   open = run.result.energy.open() / run.result.energy.initial;
      if (step < 1e-4)
      {
        EXPECT_LE(std::abs(gained), 3e7 * step * step) << integrator << " " << step;
        if (before > 0)
          EXPECT_LT(std::abs(gained), 0.05 * before) << integrator;
        before = std::abs(gained);
        report("energy", gained);
      }
      else
        EXPECT_GE(open, 0.9 * gained) << integrator << " " << step;
      // right, or told
      if (step > 1e-4)
        EXPECT_TRUE(open >= 0.5 || std::abs(gained) < 0.05) << integrator << " " << step;
    }
  }
}

// 1e9 N for a nanosecond: a velocity of impulse over mass, whatever follows.
TEST(HardSteps, ImpulsiveLoad)
{
  for (const std::string integrator : {"theta method", "exact propagator"})
  {
    PointRun run;
    run.step = 1e-9;
    run.mass = 2;
    run.integrator = integrator;
    run.gap = 1e9;
    run.force = [](const double t) { return std::abs(t - 10e-9) < 1e-10 ? 1e9 : 0.; };
    run.march(point({2 * pi}, run.mass, 1e-8));
    EXPECT_NEAR(run.rate() / 0.5, 1, 1e-9) << integrator;
    EXPECT_NEAR(run.z() / (0.5 * 990e-9), 1, 1e-6) << integrator;
    report("velocity", run.rate() / 0.5 - 1);
  }
}

// A gap of 1e-15 m under a weight: the mass comes to lie on the stop, N = m g, as with no gap.
TEST(HardSteps, GapOfAFemtometre)
{
  for (const double gap : {1e-15, 0.})
  {
    PointRun run;
    run.gap = gap;
    run.force = [](double) { return -9.81; };
    ContactPair pair = point({2 * pi * 100}, run.mass, 1e-8);
    pair.damping_ratio = {0.5};
    run.steps = 20000;
    run.march(pair);
    const double k = std::pow(2 * pi * 100, 2);
    // beside its spring: N = (m g - k gap) / (1 + k W)
    const double truth = (9.81 - k * gap) / (1 + k * 1e-8);
    EXPECT_NEAR(run.state.R[0] / truth, 1, 1e-9) << gap;
    report("force", run.state.R[0] / truth - 1);
  }
}

// A mass that touches without load and without motion stays so to the bit.
TEST(HardSteps, LoadExactlyAtLiftOff)
{
  PointRun run;
  run.steps = 2000;
  run.march(point({2 * pi * 100, 2 * pi * 1000}, run.mass, 1e-8));
  EXPECT_EQ(run.z(), 0);
  EXPECT_EQ(run.largest_force, 0);
  EXPECT_EQ(run.impacts, 0u);
  // a load that its own spring carries at the gap to the bit
  PointRun carried;
  carried.steps = 2000;
  carried.gap = 9.81 / std::pow(2 * pi * 100, 2);
  carried.displacement = -carried.gap;
  carried.force = [](double) { return -9.81; };
  carried.march(point({2 * pi * 100}, carried.mass, 1e-8));
  EXPECT_NEAR(carried.z() / -carried.gap, 1, 1e-12);
  EXPECT_LE(carried.largest_force, 1e-9 * 9.81);
  report("force over the load", carried.largest_force / 9.81);
}

// Excited at its own frequency without damping: q = F / (2 w^2) (sin wt - wt cos wt) over a thousand periods.
TEST(HardSteps, ExactResonanceWithoutDamping)
{
  const double w = 2 * pi * 100;
  for (const unsigned int per_period : {100u, 200u})
  {
    PointRun run;
    run.integrator = "exact propagator";
    run.gap = 1e9;
    run.step = 0.01 / per_period;
    run.steps = per_period * 1000;
    run.force = [=](const double t) { return std::sin(w * t); };
    run.march(point({w}, run.mass, 1e-8));
    const double t = run.step * run.steps, truth = (std::sin(w * t) - w * t * std::cos(w * t)) / (2 * w * w);
    EXPECT_NEAR(run.z() / truth, 1, 0.5 * std::pow(w * run.step, 2) / 6);
    // linear between the steps the force is less by (w h)^2 / 12
    report("amplitude after 1000 periods", run.z() / truth - 1);
  }
}

// Ten modes from 1 Hz to 1 GHz in steps of 1e-5 s: theta 1/2 keeps the energy of all.
TEST(HardSteps, ModesFromOneHertzToAGigahertz)
{
  std::vector<double> omega;
  for (unsigned int k = 0; k < 10; ++k)
    omega.push_back(2 * pi * std::pow(10., k));
  for (const std::string integrator : {"theta method", "exact propagator"})
  {
    PointRun run;
    run.integrator = integrator;
    run.gap = 1e9;
    run.velocity = 1;
    run.steps = 20000;
    run.march(point(omega, run.mass, 1e-8));
    const double kept = run.result.energy.stored / run.result.energy.initial - 1;
    EXPECT_NEAR(kept, 0, 1e-9) << integrator;
    report("energy", kept);
    // the slowest against its closed form
    const double t = run.step * run.steps;
    EXPECT_NEAR(run.state.q[0], std::sin(omega[0] * t) / omega[0], 1e-6 / omega[0]);
  }
}

// A free mass flies straight on: 3e5 steps without a force add up no drift.
TEST(HardSteps, FreeFlightWithoutDrift)
{
  PointRun run;
  run.gap = 1e9;
  run.velocity = 0.1;
  run.step = 1e-6;
  run.steps = 300000;
  run.march(point({0}, run.mass, 1e-8));
  EXPECT_EQ(run.rate(), 0.1);
  EXPECT_NEAR(run.z() / (0.1 * run.step * run.steps), 1, 1e-10);
  report("path", run.z() / (0.1 * run.step * run.steps) - 1);
}
