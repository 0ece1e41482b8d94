// Den Hartog's oscillator with Coulomb friction: the exact piecewise motion, with and without stops, has the published
// amplitude and balances work and loss.

#include "den_hartog.h"

#include <gtest/gtest.h>

using namespace vibrocontact;

namespace
{
  DenHartog oscillator(const double ratio, const double friction)
  {
    DenHartog o;
    o.mass = 2;
    o.stiffness = 8e4;
    o.force = 50;
    o.friction = friction * o.force;
    o.frequency = ratio * std::sqrt(o.stiffness / o.mass) / (2 * std::acos(-1.));
    return o;
  }
} // namespace

TEST(DenHartog, PublishedAmplitude)
{
  for (const double ratio : {0.6, 0.8, 1.2, 1.5})
    for (const double friction : {0.1, 0.3})
    {
      const DenHartog o = oscillator(ratio, friction);
      const DenHartog::Settled s = o.settle(400);
      EXPECT_LT(s.change, 1e-9);
      EXPECT_LT(s.sticking, 1e-9) << ratio << " " << friction;
      EXPECT_NEAR(s.largest / o.closed_form(), 1, 1e-8) << ratio << " " << friction;
      EXPECT_NEAR(s.smallest / o.closed_form(), -1, 1e-8);
      EXPECT_NEAR(s.work / s.loss, 1, 1e-8);
    }
}

TEST(DenHartog, StopsAndSticking)
{
  // springs on both sides without gap: a stiffer oscillator
  DenHartog both = oscillator(0.8, 0.2), stiff = both;
  both.gap = 0;
  both.both_sides = true;
  both.stop_stiffness = 2e4;
  stiff.stiffness += both.stop_stiffness;
  EXPECT_NEAR(both.settle(400).largest / stiff.closed_form(), 1, 1e-8);
  // one stop, and slow motion that sticks: what the force does is what friction takes
  DenHartog stop = oscillator(1.2, 0.2);
  stop.gap = 0.5e-3;
  stop.stop_stiffness = 5e5;
  const DenHartog::Settled s = stop.settle(600);
  EXPECT_GT(s.largest, stop.gap);
  EXPECT_LT(s.change, 1e-9);
  EXPECT_NEAR(s.work / s.loss, 1, 1e-8);
  const DenHartog::Settled slow = oscillator(0.21, 0.8).settle(100);
  EXPECT_GT(slow.sticking, 0.05);
  EXPECT_LT(slow.change, 1e-9);
  EXPECT_NEAR(slow.work / slow.loss, 1, 1e-8);
}
