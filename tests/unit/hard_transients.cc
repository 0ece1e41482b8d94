// Transients that are hard on the contact solver converge and stay finite: friction 1, contact lost and regained, one point,
// no normal force, creepage that reverses, steps a hundred times too long.

#include "pi.h"

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/marching/initial_state.h>
#include <vibrocontact/marching/transient_march.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;

namespace
{
  /// Steel half-spaces, radius 0.3 m, that three modes of a 20 kg body move as a whole: lateral 400 Hz, normal 600 Hz, and
  /// one that couples both at 1 kHz.
  ContactPair half_spaces_with_modes(const unsigned int n_x, const unsigned int n_y)
  {
    ContactPair pair;
    ContactGrid &grid = pair.interface.contacts.only();
    grid.n_x = n_x;
    grid.n_y = n_y;
    grid.spacing_x = grid.spacing_y = 2e-3;
    grid.x_first = -2e-3 * (n_x / 2);
    grid.y_first = -2e-3 * (n_y / 2);
    const unsigned int n = grid.n_points();
    for (unsigned int i = 0; i < n; ++i)
      pair.interface.gap.push_back((grid.x(i) * grid.x(i) + grid.y(i) * grid.y(i)) / 0.6);
    const HalfSpaceMaterial steel{206e9, 0.3};
    pair.residual = half_space_compliance(grid, HalfSpacePair(steel, steel));
    pair.trace.reinit(3 * n, 3);
    pair.participation.reinit(3, 3);
    const double frequencies[] = {400, 600, 1000}, shape = 1 / std::sqrt(20.);
    const double directions[3][3] = {{0, 0, 1}, {1, 0, 0}, {0.6, 0, 0.8}};
    for (unsigned int k = 0; k < 3; ++k)
    {
      pair.omega.push_back(2 * pi * frequencies[k]);
      pair.damping_ratio.push_back(1e-3);
      pair.labels.push_back("body:" + std::to_string(k));
      pair.body.push_back(1);
      pair.modal_load.push_back(0);
      pair.participation(k, 2) = directions[k][0] / shape;
      for (unsigned int c = 0; c < 3; ++c)
        for (unsigned int i = 0; i < n; ++i)
          pair.trace(c * n + i, k) = directions[k][c] * shape;
    }
    return pair;
  }

  struct Oscillator
  {
    double friction = 0.3, step = 1e-5, end = 8e-3;
    unsigned int n_x = 11, n_y = 9;
    std::string creepage = "0.005", force, hub;
    std::string integrator = "theta method", initial_state = "quasi-static";
  };

  struct Outcome
  {
    TransientResult result;
    double largest_force = 0, penetration = 0;
    unsigned int times_open = 0, times_closed = 0;
  };

  /// The deepest of all points, whether the step looked at them or not [m].
  double penetration(const ContactPair &pair, const DynamicState &state)
  {
    double deepest = 0;
    for (unsigned int i = 0; i < pair.n_points(); ++i)
    {
      double gap = pair.interface.gap[i] - state.contact.approach;
      for (unsigned int k = 0; k < pair.n_modes(); ++k)
        gap += pair.trace(i, k) * state.q[k];
      for (unsigned int j = 0; j < state.R.size(); ++j)
        gap += pair.residual(i, j) * state.R[j];
      deepest = std::max(deepest, -gap);
    }
    return deepest;
  }

  Outcome run(const Oscillator &c)
  {
    const ContactPair pair = half_spaces_with_modes(c.n_x, c.n_y);
    TransientParameters p;
    p.time_step = c.step;
    p.end_time = c.end;
    p.integrator = c.integrator;
    p.initial_state = c.initial_state;
    p.lateral_creepage = c.creepage;
    p.normal_force = c.force;
    p.hub_displacement = c.hub;
    ContactParameters contact;
    contact.friction = c.friction;
    const ContactSolverParameters solver;
    RollingCase constant;
    constant.creepage = {10, 0, 0, 0};
    constant.normal_force = 20e3;
    const DriveFunction drive = drive_function(p, constant, pair.interface.contacts.only());
    DynamicState state = initial_state(p, contact, solver, pair, drive(0));
    Outcome outcome;
    bool was_open = false;
    outcome.result = transient(p, contact, solver, pair, drive, state,
                               [&](const DynamicState &s, const TransientResult &)
                               {
                                 double sum = 0;
                                 for (unsigned int i = 0; i < s.R.size(); ++i)
                                 {
                                   EXPECT_TRUE(std::isfinite(s.R[i]));
                                   sum += i < s.R.size() / 3 ? s.R[i] : 0.;
                                 }
                                 for (unsigned int k = 0; k < s.q.size(); ++k)
                                   EXPECT_TRUE(std::isfinite(s.q[k]) && std::isfinite(s.v[k]));
                                 outcome.penetration = std::max(outcome.penetration, penetration(pair, s));
                                 outcome.largest_force = std::max(outcome.largest_force, sum);
                                 const bool open = sum == 0;
                                 outcome.times_open += open && !was_open;
                                 outcome.times_closed += !open && was_open;
                                 was_open = open;
                                 return true;
                               });
    EXPECT_TRUE(std::isfinite(outcome.result.energy.imbalance()));
    EXPECT_LT(outcome.penetration * 1e6, 1e-4) << "um, on an approach of some 50";
    std::printf(
        "%s: %lu steps, %.1f iterations per step, %lu fallbacks, largest force %.3g N, opened %u times %s\n",
        testing::UnitTest::GetInstance()->current_test_info()->name(), outcome.result.steps,
        outcome.result.iterations / std::max(1., double(outcome.result.steps)), outcome.result.fallbacks,
        outcome.largest_force, outcome.times_open, outcome.result.message.c_str());
    return outcome;
  }
} // namespace

TEST(HardTransients, FrictionOne)
{
  Oscillator c;
  c.friction = 1;
  c.creepage = "0.01*sin(2*pi*t/3e-3)";
  c.force = "20e3*(1+0.9*sin(2*pi*t/1e-3))";
  EXPECT_TRUE(run(c).result.converged);
}

TEST(HardTransients, CreepageReverses)
{
  Oscillator c;
  c.creepage = "0.005*cos(2*pi*t/2e-3)";
  EXPECT_TRUE(run(c).result.converged);
}

TEST(HardTransients, ContactLostAndRegained)
{
  Oscillator c;
  c.hub = "0.05e-3*cos(2*pi*t/2e-3)";
  for (const std::string integrator : {"theta method", "exact propagator"})
  {
    c.integrator = integrator;
    const Outcome outcome = run(c);
    EXPECT_TRUE(outcome.result.converged);
    EXPECT_GE(outcome.times_open, 3u);
    EXPECT_GE(outcome.times_closed, 3u);
  }
}

TEST(HardTransients, OnePoint)
{
  Oscillator c;
  c.n_x = c.n_y = 1;
  c.initial_state = "undeformed";
  c.hub = "0.05e-3*cos(2*pi*t/2e-3)";
  EXPECT_TRUE(run(c).result.converged);
  // a grid of which one point is loaded, then none, then one
  Oscillator light;
  light.hub = "1e-6*cos(2*pi*t/2e-3)";
  light.creepage = "1e-4*cos(2*pi*t/3e-3)";
  EXPECT_TRUE(run(light).result.converged);
}

TEST(HardTransients, NoNormalForce)
{
  // bodies that just touch, and that are apart
  Oscillator c;
  for (const std::string hub : {"0", "-1e-5"})
  {
    c.hub = hub;
    const Outcome outcome = run(c);
    EXPECT_TRUE(outcome.result.converged);
    EXPECT_EQ(outcome.largest_force, 0);
  }
  // a force of zero leaves the approach open: refused with the reason, at once or where it happens
  c.hub = "";
  c.force = "0";
  EXPECT_THROW(run(c), InputError);
  c.force = "20e3*(1-t/4e-3)";
  const Outcome outcome = run(c);
  EXPECT_FALSE(outcome.result.converged);
  EXPECT_NE(outcome.result.message.find("Normal force"), std::string::npos);
  EXPECT_NEAR(outcome.result.time, 4e-3, 2e-5);
}

TEST(HardTransients, StepsAHundredTimesTooLong)
{
  Oscillator c;
  c.step = 1e-3;
  c.end = 0.2;
  c.hub = "0.04e-3*(1+cos(2*pi*t/13e-3))-0.01e-3";
  c.creepage = "0.005*cos(2*pi*t/9e-3)";
  for (const std::string integrator : {"theta method", "exact propagator"})
  {
    c.integrator = integrator;
    const Outcome outcome = run(c);
    // may be refused, but not without a reason
    EXPECT_TRUE(outcome.result.converged || !outcome.result.message.empty());
  }
}
