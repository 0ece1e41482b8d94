// One point from event to event at its limits: a force that touches zero to 1e-9, poles on the axis, resonance, slopes that
// hardly lift, speeds of a millionth.

#include "../unit/pi.h"
#include "report.h"

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/propagators/event_located.h>
#include <vibrocontact/propagators/propagator.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;

namespace
{
  constexpr double mass = 1, stiffness = 4e5, amplitude = 5e-3, wavelength = 0.025;
  const double omega = std::sqrt(stiffness / mass);

  struct Ride
  {
    double zeta = 0.02, gravity = 9.81, speed = 0.1, height = amplitude;
    std::vector<ContactEvent> impacts, releases;
    double impulse = 0, displacement = 0, distance = 0;

    double rate() const { return 2 * pi * speed / wavelength; }
    /// amplitude of the force that moves the mass along the road [N]
    double force() const
    {
      const double w = rate();
      return height * std::abs(std::complex<double>(stiffness - mass * w * w, 2 * zeta * omega * mass * w));
    }
    void go(const double end)
    {
      DenseMatrix trace(1, 1);
      trace(0, 0) = 1 / std::sqrt(mass);
      const BodyInContact model =
          by_poles({{omega}, {zeta}, trace, {-gravity * std::sqrt(mass)}, DenseMatrix(), {}});
      RoadParameters parameters;
      parameters.profile = "expression";
      char text[80];
      std::snprintf(text, sizeof text, "%.17g*sin(2*pi*s/0.025)", height);
      parameters.expression = text;
      parameters.speed = speed;
      const Road road(parameters, {0.}, {0.}, end);
      EventLocated motion(model, state_at_rest(model), road, 1e-2);
      motion.advance(end,
                     [&](const EventLocated::Piece &piece)
                     {
                       displacement = piece.u(0, piece.end);
                       for (unsigned int k = 0; k <= 16 && piece.closed[0]; ++k)
                       {
                         const double t = piece.begin + (piece.end - piece.begin) * k / 16;
                         distance = std::max(distance, std::abs(piece.u(0, t) - road.height(0, t)));
                       }
                     });
      impacts = motion.impacts;
      releases = motion.releases;
      impulse = motion.impulse[0];
    }
  };
} // namespace

// The weight is what the road's inertia and spring need to 1e-9: from the first touch on it never lifts off above, and does so
// once in each period below.
TEST(HardEvents, WeightExactlyAtLiftOff)
{
  for (const double share : {1e-3, 1e-9, 1e-13, -1e-13, -1e-9, -1e-3})
  {
    Ride ride;
    ride.gravity = ride.force() / mass * (1 + share);
    ride.go(5 * wavelength / ride.speed);
    if (share > 1e-12)
      EXPECT_EQ(ride.releases.size(), 0u) << share;
    if (share < -1e-12)
      EXPECT_EQ(ride.releases.size(), 5u) << share;
    EXPECT_LT(ride.distance, 1e-12);
  }
}

// Poles on the axis, the road at their frequency: the road needs no force, N = m g, though nothing bounds a free motion there.
TEST(HardEvents, RoadAtAnUndampedResonance)
{
  Ride ride;
  ride.zeta = 0;
  ride.speed = omega * wavelength / (2 * pi);
  const double end = 1;
  ride.go(end);
  // the impact at the beginning gives the mass the road's rate
  double struck = 0;
  for (const ContactEvent &impact : ride.impacts)
    struck += impact.impulse;
  EXPECT_EQ(ride.releases.size(), 0u);
  EXPECT_NEAR((ride.impulse - struck) / (mass * ride.gravity * end), 1, 1e-8);
  report("impulse", (ride.impulse - struck) / (mass * ride.gravity * end) - 1);
}

// A road of a picometre under a body at rest: its weight, whose impulse has the road's first impact beside it, m v.
TEST(HardEvents, RoadOfAPicometre)
{
  Ride ride;
  ride.height = 1e-12;
  ride.go(1);
  EXPECT_EQ(ride.releases.size(), 0u);
  // from rest to the road's rate, over whole periods of it
  const double truth = mass * ride.gravity + mass * ride.height * ride.rate();
  EXPECT_NEAR(ride.impulse / truth, 1, 1e-12);
  report("impulse", ride.impulse / truth - 1);
}
