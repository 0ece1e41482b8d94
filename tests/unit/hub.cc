// The hub of body 1: held, massless and suspended against closed forms, against each other and in time.

#include "held_bar.h"
#include "pi.h"
#include "random_structure.h"
#include "root_distance.h"

#include <vibrocontact/analyses/stability/stability.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/coupled_bodies/suspended_pair.h>
#include <vibrocontact/marching/hub_motion.h>
#include <vibrocontact/marching/initial_state.h>
#include <vibrocontact/marching/transient_march.h>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

using namespace vibrocontact;

namespace
{
  /// Root of a function between two places of different sign.
  template <typename Function>
  double zero(const Function &f, double low, double high)
  {
    for (unsigned int i = 0; i < 200; ++i)
    {
      const double middle = (low + high) / 2;
      (f(low) * f(middle) <= 0 ? high : low) = middle;
    }
    return (low + high) / 2;
  }

  SuspensionParameters suspension(const double mass, const double stiffness, const double damping)
  {
    SuspensionParameters s;
    s.mass = mass;
    std::fill_n(s.stiffness, 3, stiffness);
    std::fill_n(s.damping, 3, damping);
    return s;
  }

  std::vector<StabilityRoot> roots_of(const ContactPair &pair, RollingEquilibrium about,
                                      const bool force_given = false)
  {
    about.force_given = force_given;
    return stability_roots(pair, linearised_contact(pair, creep_schemes().front(), about, {}));
  }
} // namespace

TEST(Hub, BarOnASuspendedHubHasTheFrequenciesOfItsClosedForm)
{
  // free tip, mass m and spring k at the other end: (k - m w^2) cos w = w sin w
  const double mass = 0.7, stiffness = 3;
  const auto f = [&](const double w) { return (stiffness - mass * w * w) * std::cos(w) - w * std::sin(w); };
  SuspensionParameters s = suspension(1 + mass, 0, 0);
  s.stiffness[2] = stiffness;
  const ContactPair bar = suspended_pair(held_bar(400, 1e-3), suspended_hub(s));
  std::vector<double> omega(bar.omega);
  std::sort(omega.begin(), omega.end());
  // two translations across the bar without springs
  EXPECT_LT(omega[1], 1e-5);
  unsigned int k = 2;
  for (double w = 1e-3; k < 7; w += 1e-3)
    if (f(w) * f(w + 1e-3) < 0)
    {
      const double exact = zero(f, w, w + 1e-3);
      std::printf("w %.9f, closed form %.9f\n", omega[k], exact);
      EXPECT_NEAR(omega[k] / exact, 1, 1e-8);
      ++k;
    }
  // modes have unit mass: the mobility of the tip at high frequency is that of the bar, its sum of squares
  double moved = 0;
  for (unsigned int j = 0; j < bar.n_modes(); ++j)
    moved += std::pow(bar.hub->motion(2, j), 2);
  // (M - Gamma^T Gamma)^-1
  double participating = 0;
  for (unsigned int j = 0; j < 400; ++j)
    participating += std::pow(bar.hub->coupling(j, 2), 2);
  EXPECT_NEAR(moved * (1 + mass - participating), 1, 1e-9);
}

TEST(Hub, RigidWheelOnItsSpringHasTheRootOfAnOscillator)
{
  ContactPair pair;
  pair.interface.contacts.only().n_x = pair.interface.contacts.only().n_y = 1;
  pair.interface.contacts.only().spacing_x = pair.interface.contacts.only().spacing_y = 1e-3;
  pair.interface.gap = {0.};
  pair.residual.reinit(3, 3);
  pair.trace.reinit(3, 0);
  const double w = 1e-9, m = 600, k = 2e8, c = 3e5;
  for (unsigned int i = 0; i < 3; ++i)
    pair.residual(i, i) = w;
  const ContactPair wheel = suspended_pair(pair, suspended_hub(suspension(m, k, c)));
  const std::vector<StabilityRoot> roots = roots_of(wheel, sliding(1, 0.3, 5e4, 0.5));
  const double decay = c / (2 * m), frequency = std::sqrt((k + 1 / w) / m - decay * decay) / (2 * pi);
  const auto on_contact = std::find_if(roots.begin(), roots.end(),
                                       [](const StabilityRoot &root) { return root.label == "hub:z"; });
  ASSERT_NE(on_contact, roots.end());
  EXPECT_NEAR(on_contact->frequency / frequency, 1, 1e-9);
  EXPECT_NEAR(-on_contact->growth / decay, 1, 1e-9);
}

TEST(Hub, DampingOfTheHeldModesActsAsAWhole)
{
  ContactPair bar = held_bar(12, 1e-3);
  for (unsigned int k = 0; k < 12; ++k)
    bar.damping_ratio[k] = 1e-3 * (1 + k % 5);
  const SuspensionParameters s = suspension(1.7, 3, 0.4);
  const ContactPair pair = suspended_pair(bar, suspended_hub(s));
  const unsigned int n = pair.n_modes();
  double largest = 0, between = 0, most = 0;
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
    {
      double expected = 0;
      for (unsigned int k = 0; k < 12; ++k)
        expected += pair.hub->shapes(k, i) * 2 * bar.damping_ratio[k] * bar.omega[k] * pair.hub->shapes(k, j);
      for (unsigned int d = 0; d < 3; ++d)
        expected += s.damping[d] * pair.hub->motion(d, i) * pair.hub->motion(d, j);
      const double own = i == j ? 2 * pair.damping_ratio[i] * pair.omega[i] : 0.;
      largest = std::max(largest, std::abs(own + pair.hub->modal_damping(i, j) - expected));
      if (i == j)
        most = std::max(most, expected);
      else
        between = std::max(between, std::abs(expected));
    }
  EXPECT_GT(between, 1e-2);
  EXPECT_LT(largest, 1e-6 * most);
}

// The first mode of a bar alone, on a light hub with a spring: two masses, whose roots are those of their matrices.
TEST(Hub, DampedMassOnALightHubHasTheRootsOfTwoMasses)
{
  ContactPair bar = held_bar(1, 0.);
  bar.damping_ratio[0] = 0.02;
  const double gamma = bar.participation(0, 2), mass = gamma * gamma + 0.3, stiffness = 0.8, w = bar.omega[0],
               c = 2 * 0.02 * w;
  SuspensionParameters s = suspension(mass, 1e-3, 0);
  s.stiffness[2] = stiffness;
  s.damping[2] = 0.01;
  const ContactPair pair = suspended_pair(bar, suspended_hub(s));
  // q'' + gamma y'' + c q' + w^2 q = 0, gamma q'' + mass y'' + 0.01 y' + stiffness y = 0
  const auto determinant = [&](const std::complex<double> l)
  { return (l * l + c * l + w * w) * (mass * l * l + 0.01 * l + stiffness) - std::pow(gamma * l * l, 2); };
  RollingEquilibrium open = sliding(1, 0.3, 5e4, 0.5);
  open.contact.status.assign(1, ContactStatus::open);
  unsigned int n_found = 0;
  for (const StabilityRoot &root : roots_of(pair, open))
    if (root.label == "bar:0" || root.label == "hub:z")
    {
      const std::complex<double> l(root.growth, 2 * pi * root.frequency);
      EXPECT_LT(std::abs(determinant(l)), 1e-7 * std::pow(std::abs(l), 4)) << root.label;
      ++n_found;
    }
  EXPECT_EQ(n_found, 2u);
}

TEST(Hub, LimitsAreHeldAndMassless)
{
  const Structure s = structure(90, 5);
  ContactPair pair = reduce(s, 30, 2e-3);
  pair.participation.reinit(30, 3);
  for (unsigned int k = 0; k < 30; ++k)
    for (unsigned int d = 0; d < 3; ++d)
      pair.participation(k, d) = 0.3 * std::sin(1. + k + 7 * d);
  const RollingEquilibrium about = sliding(5, 0.35, 300, 0.5);
  const std::vector<StabilityRoot> held = roots_of(pair, about);
  ASSERT_GT(held.size(), 20u);
  for (const SuspensionParameters &far :
       {suspension(1e12, 0, 0), suspension(50, 1e15, 0), suspension(50, 0, 1e12)})
    EXPECT_LT(distance(held, roots_of(suspended_pair(pair, suspended_hub(far)), about)), 1e-5);
  EXPECT_GT(distance(held, roots_of(suspended_pair(pair, suspended_hub(suspension(50, 1e6, 0))), about)),
            1e-3);

  // a hub that moves no mass and meets no spring along z, the modes being those of the other body
  pair.body.assign(30, 2);
  SuspensionParameters light = suspension(1e-7, 1e14, 0);
  light.stiffness[2] = 0;
  const std::vector<StabilityRoot> massless = roots_of(pair, about, true);
  EXPECT_GT(distance(massless, held), 1e-3);
  EXPECT_LT(distance(massless, roots_of(suspended_pair(pair, suspended_hub(light)), about)), 1e-5);
}

TEST(Hub, LoadThatJumpsOnASuspendedWheelMovesItAsItsClosedForm)
{
  auto pair = std::make_shared<ContactPair>();
  pair->interface.contacts.only().n_x = pair->interface.contacts.only().n_y = 1;
  pair->interface.contacts.only().spacing_x = pair->interface.contacts.only().spacing_y = 1e-3;
  pair->interface.gap = {0.};
  pair->residual.reinit(3, 3);
  pair->trace.reinit(3, 0);
  const double w = 1e-9, m = 600, k = 2e8, c = 3e5, N = 5e4, step = 1e4, h = 2e-6;
  for (unsigned int i = 0; i < 3; ++i)
    pair->residual(i, i) = w;
  RollingParameters rolling;
  rolling.suspension = suspension(m, k, c);
  ContactParameters contact;
  contact.friction = 0;
  const ContactSolverParameters solver;
  LoadOverTime load;
  load.normal_force = true;
  const DriveFunction drive = [&](const double t)
  {
    Drive now;
    now.creepage.speed = 1;
    now.normal_force = N + (t > 0 ? step : 0);
    return now;
  };
  const HubMotion hub = hub_motion("suspended", rolling, load, contact, solver, pair, drive);
  EXPECT_NEAR(hub.place / (N * w), 1, 1e-9);
  const double decay = c / (2 * m), total = k + 1 / w, omega = std::sqrt(total / m - decay * decay);
  for (const char *const integrator : {"theta method", "exact propagator"})
  {
    TransientParameters parameters;
    parameters.integrator = integrator;
    parameters.time_step = h;
    parameters.end_time = 0.02;
    DynamicState state = initial_state(parameters, contact, solver, *pair, hub);
    double worst = 0;
    const TransientResult result = transient(
        parameters, contact, solver, *hub.pair, hub.drive, state,
        [&](const DynamicState &now, const TransientResult &)
        {
          // the load is linear in the first step
          const double t = now.time - h / 2;
          const double pressed =
              step / total *
              (1 - std::exp(-decay * t) * (std::cos(omega * t) + decay / omega * std::sin(omega * t)));
          worst = std::max(worst, std::abs(now.R[0] - N - pressed / w) / step);
          return true;
        });
    std::printf(
        "%s: force against the closed form %.2e of the jump, imbalance of the energy %.2e of what it put "
        "in\n",
        integrator, worst, result.energy.imbalance() / result.energy.input());
    EXPECT_TRUE(result.converged);
    EXPECT_LT(worst, 2e-6);
    EXPECT_LT(std::abs(result.energy.imbalance()), 1e-3 * std::abs(result.energy.input()));
  }
}

TEST(Hub, WhatALoadOverTimeMoves)
{
  LoadOverTime force, displacement;
  force.normal_force = displacement.hub_displacement = true;
  force.name = "Transient/Normal force";
  displacement.name = "Transient/Hub displacement";
  EXPECT_EQ(transient_hub("held", force), "massless");
  EXPECT_EQ(transient_hub("suspended", force), "suspended");
  EXPECT_EQ(transient_hub("none", force), "none");
  EXPECT_EQ(transient_hub("held", {}), "held");
  EXPECT_EQ(transient_hub("held", displacement), "held");
  EXPECT_THROW(transient_hub("massless", displacement), InputError);
  EXPECT_THROW(transient_hub("suspended", displacement), InputError);
}

TEST(Hub, UnsprungMassIsThatOfBody1AtLeast)
{
  EXPECT_THROW(suspended_pair(held_bar(50, 1e-3), suspended_hub(suspension(0.9, 1, 0))), InputError);
}
