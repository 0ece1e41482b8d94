// A bar dropped on a rigid stop, by finite elements with a massless contact node: the closed form of its first contacts, and what
// theta and the mass of the contact node do.

#include "element_scene.h"

#include <vibrocontact/marching/initial_state.h>
#include <vibrocontact/marching/transient_march.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;

namespace
{
  // first contact from 1 s to 1.6667 s with the force 300 (1 + s), s the time since; second, its time reverse, from 3.6667 s; at
  // rest where it began at 5.3333 s
  constexpr double length = 10, wave_speed = 30, height = 5, gravity = 10, impact_speed = 10, touch = 1,
                   contact = 2 * length / wave_speed, period = 4 + 2 * contact;

  struct Scheme
  {
    unsigned int elements;
    /// c dt / element
    double courant;
    /// 0: as suits the step
    double consistent_mass = 0;
    double theta = 0.5;
    bool massless = true;
    std::string reaction = "as other forces";
  };

  struct Contact
  {
    double begin = -1, end = -1, peak = 0;
    unsigned int changes = 0;
  };

  struct Drop
  {
    double step = 0;
    /// of the first contact: errors of touch (gap, extrapolated) and of the release, where the force falls through half of what
    /// it was [s]; rms error of the force in the middle 80 % over its rms
    double begin = 0, end = 0, force = 0;
    /// relative to what the closed form has
    double energy = 0, penetration = 0;
    Contact first, second, third;
  };

  std::unique_ptr<ElementScene> dropped_bar(const Scheme &scheme)
  {
    BarParameters bar;
    bar.divisions = scheme.elements;
    bar.degree = 1;
    bar.massless_contact_node = scheme.massless;
    bar.consistent_mass =
        scheme.consistent_mass > 0 ? scheme.consistent_mass : 0.5 + scheme.courant * scheme.courant;
    return bar_scene(bar, 4, gravity);
  }

  Drop drop(const Scheme &scheme, const double end = 3 * period)
  {
    const auto scene = dropped_bar(scheme);
    Drop result;
    result.step = scheme.courant * length / scheme.elements / wave_speed;
    TransientParameters parameters;
    parameters.time_step = result.step;
    parameters.end_time = end;
    parameters.initial_state = "undeformed";
    parameters.initial_gap = height;
    parameters.theta = scheme.theta;
    parameters.reaction = scheme.reaction;
    ContactParameters contact_parameters;
    contact_parameters.friction = 0;
    const DriveFunction drive = [](double)
    {
      Drive still;
      still.creepage.speed = 0;
      return still;
    };
    const auto plateau = [](const double t) { return wave_speed * (impact_speed + gravity * (t - touch)); };
    DynamicState state = initial_state(parameters, contact_parameters, {}, scene->all, drive(0));
    double gap = height, gap_before = height, force_before = 0, errors = 0, squares = 0;
    result.begin = result.end = -1;
    const auto observe = [&](const DynamicState &s, const TransientResult &)
    {
      const double t = s.time, R = s.R[0], half = 0.5 * plateau(touch + contact);
      if (result.begin == -1 && R > 0)
        result.begin = t - result.step + gap * result.step / (gap_before - gap) - touch;
      if (result.end == -1 && t > touch + 0.5 * contact && R < half)
        result.end = t - result.step * (half - R) / (force_before - R) - touch - contact;
      if (t > touch + 0.1 * contact && t < touch + 0.9 * contact)
      {
        errors += std::pow(R - plateau(t), 2);
        squares += std::pow(plateau(t), 2);
      }
      const double since = t - (touch - 0.7);
      Contact &now = since < contact + 1.4         ? result.first
                     : since < 2 * (contact + 1.4) ? result.second
                                                   : result.third;
      if (since > 0 && t < touch + period + contact + 0.7)
      {
        if (R > 0)
        {
          now.begin = now.begin < 0 ? t : now.begin;
          now.end = t;
        }
        now.peak = std::max(now.peak, R / plateau(touch + contact));
        now.changes += (R > 0) != (force_before > 0);
      }
      gap_before = gap;
      gap = s.contact.y[0];
      force_before = R;
      return true;
    };
    const TransientResult run =
        transient(parameters, contact_parameters, {}, scene->all, drive, state, observe);
    EXPECT_TRUE(run.converged);
    result.force = std::sqrt(errors / squares);
    // potential of gravity counts: the bar has dropped by what the loads have worked
    const double whole = length * gravity * height;
    result.energy = (run.energy.stored - run.energy.initial - run.energy.loads) / whole;
    result.penetration = -run.smallest_gap / height;
    return result;
  }

  void print(const Scheme &scheme, const Drop &d)
  {
    std::printf(
        "| %u | %.4g | %.4g | %s | %s | %.2g | %+.1e | %+.1f | %.1e | %.3f | %+.1e %+.1e %.3f %u | %+.1e "
        "%+.1e %.3f %u | %+.1e |\n",
        scheme.elements, scheme.courant,
        scheme.consistent_mass > 0 ? scheme.consistent_mass : 0.5 + scheme.courant * scheme.courant,
        scheme.massless ? "no" : "yes", scheme.reaction.c_str(), scheme.theta, d.begin, d.end / d.step,
        d.force, d.first.peak, d.second.begin - touch - contact - 2, d.second.end - touch - 2 * contact - 2,
        d.second.peak, d.second.changes, d.third.begin - touch - period,
        d.third.end - touch - contact - period, d.third.peak, d.third.changes, d.energy);
  }
} // namespace

TEST(BarUnderGravity, FirstContactAsTheClosedForm)
{
  for (const unsigned int n : {100u, 200u, 400u})
    for (const double courant : {1., 0.5, 0.25})
    {
      const Scheme scheme{n, courant};
      const Drop d = drop(scheme);
      print(scheme, d);
      EXPECT_LT(std::abs(d.begin), 1e-4);
      EXPECT_LT(std::abs(d.end), 2 * d.step);
      EXPECT_LT(d.force, 1e-4);
      EXPECT_EQ(d.first.changes, 2u);
      EXPECT_LT(d.penetration, 1e-11);
      EXPECT_LT(std::abs(d.energy), courant == 0.25 ? 1e-3 : 1e-2);
      // later contacts: of first order in the element
      EXPECT_LT(std::abs(d.second.begin - touch - contact - 2), 1.2 / n);
      EXPECT_LT(std::abs(d.third.begin - touch - period), 1.6 / n);
    }
}

TEST(BarUnderGravity, WhatThetaAndMassDo)
{
  const auto shown = [](const Scheme &scheme)
  {
    const Drop d = drop(scheme, 8);
    print(scheme, d);
    return d;
  };
  // consistent mass with short steps: waves ahead of the front
  EXPECT_GT(shown({100, 0.25, 1.}).force, 1e-2);
  // reaction of the end of the step: takes energy
  EXPECT_LT(shown({100, 0.5, 0, 0.5, true, "end of step"}).energy, -1e-2);
  // theta > 1/2: takes energy
  const double least = shown({100, 0.5, 0, 0.55}).energy, most = shown({100, 0.5, 0, 1.}).energy;
  EXPECT_LT(least, -0.05);
  EXPECT_LT(most, 3 * least);
  // mass on the node: rings, or chatters and gains energy
  EXPECT_GT(shown({100, 0.5, 0, 0.5, false, "end of step"}).force, 0.1);
  const Drop chatter = shown({100, 0.5, 0, 0.5, false, "as other forces"});
  EXPECT_GT(chatter.first.changes, 20u);
  EXPECT_GT(chatter.energy, 1.);
  // and theta = 1 makes up for it, at the price of the energy
  const Drop damped = shown({100, 0.5, 0, 1., false, "end of step"});
  EXPECT_LT(damped.force, 1e-2);
  EXPECT_LT(damped.energy, -0.1);
}
