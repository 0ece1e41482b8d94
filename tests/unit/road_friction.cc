// Friction on the road: stick-slip and Coulomb damping of one point in closed form, three points of a ring.
#include "pi.h"
#include "scratch_folder.h"

#include <vibrocontact/analyses/modal_convolution/modal_convolution.h>
#include <vibrocontact/analyses/modal_convolution/road_contact.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/bodies/ring_poles.h>
#include <vibrocontact/contact/laws/friction_laws.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

using namespace vibrocontact;

namespace
{
  /// A mass of 2 kg lies on a flat road under its weight; along the road 1 kg on an undamped spring.
  constexpr double stiffness = 1e4, omega = 100, mu = 0.4, normal_force = 2 * 9.81;
  /// displacement under the sliding force [m]
  constexpr double slip_displacement = mu * normal_force / stiffness;

  struct Ride
  {
    std::vector<double> displacement, force, tangential_displacement, tangential_force;
    ModalConvolutionResult result;
  };

  Ride run(const BodyInContact &model, const Road &road, const ModalConvolutionParameters &parameters,
           const std::shared_ptr<const FrictionLaw> &friction)
  {
    ContactSolverParameters accurate;
    accurate.tolerance = 1e-13;
    ModalConvolution motion(parameters, accurate, model, road, {create_normal_law("signorini"), friction});
    Ride outcome;
    const auto keep = [&](const ModalConvolutionLines &lines)
    {
      const auto append = [&](std::vector<double> &to, const double *from)
      {
        if (from)
          to.insert(to.end(), from, from + lines.n_lines * lines.n_points);
      };
      append(outcome.displacement, lines.displacement);
      append(outcome.force, lines.force);
      append(outcome.tangential_displacement, lines.tangential_displacement);
      append(outcome.tangential_force, lines.tangential_force);
    };
    while (motion.advance(1000, keep))
      ;
    outcome.result = motion.result();
    return outcome;
  }

  /// @param pull constant force on the mass along the road [N]
  Ride run_point(const double sliding_speed, const double pull, const double step, const double end,
                 const std::shared_ptr<const FrictionLaw> &friction = create_friction_law("coulomb", {mu}))
  {
    DenseMatrix trace(2, 2);
    trace(0, 0) = std::sqrt(0.5);
    trace(1, 1) = 1;
    const BodyInContact model =
        by_poles({{300., omega}, {0.1, 0.}, trace, {-std::sqrt(2.) * 9.81, pull}, DenseMatrix(2, 2), {}});
    RoadParameters parameters;
    parameters.sliding_speed = sliding_speed;
    const Road road(parameters, {0.}, {0.}, end);
    ModalConvolutionParameters own;
    own.time_step = step;
    own.end_time = end;
    return run(model, road, own, friction);
  }

  /// The ring of doc/theory.md, at rest, on three points.
  struct Tyre
  {
    Tyre()
    {
      ring.tread_stiffness = 3e5;
      ring.tread_tangential_stiffness = 1e5;
      ring.highest_order = 30;
      ring.residual_order = 2000;
      road.profile = "ISO 8608";
      road.speed = 80 / 3.6;
      road.indentation = 1e-3;
      road.loading_time = 0.02;
      own.force_shape = "linear";
      own.time_step = 20e-6;
      own.end_time = 0.05;
      for (const double angle : ring.angles())
      {
        places.push_back(ring.radius * angle);
        shapes.push_back(ring.radius * (1 - std::cos(angle)));
      }
    }
    Ride run(const double friction, const bool with_friction = true) const
    {
      return ::run(ring_poles(ring, ring_rows(ring, with_friction)), Road(road, places, shapes, own.end_time),
                   own, create_friction_law("coulomb", {friction}));
    }
    RingParameters ring;
    RoadParameters road;
    ModalConvolutionParameters own;
    std::vector<double> places, shapes;
  };

  double largest_difference(const std::vector<double> &a, const std::vector<double> &b)
  {
    EXPECT_EQ(a.size(), b.size());
    double result = 0;
    for (std::size_t k = 0; k < a.size(); ++k)
      result = std::max(result, std::abs(a[k] - b[k]));
    return result;
  }

  double largest(const std::vector<double> &a)
  {
    return largest_difference(a, std::vector<double>(a.size(), 0.));
  }
} // namespace

// A belt under a mass whose friction falls with the slip speed along a straight line: a linear oscillator with negative
// damping, whose swing about N mu / k grows.
TEST(RoadFriction, FallingFrictionSwingsUpAsTheClosedForm)
{
  const double V = 1, fall = 0.02, end = 1;
  const auto law = create_friction_law("friction curve", {0, 0.5, 10, 0.5 - 10 * fall});
  const double decay = -0.5 * normal_force * fall, omega_d = std::sqrt(omega * omega - decay * decay),
               mean = -normal_force * (0.5 - fall * V) / stiffness;
  std::vector<double> errors;
  for (const double step : {2e-4, 1e-4, 5e-5})
  {
    const Ride found = run_point(V, 0, step, end, law);
    double worst = 0, largest_swing = 0;
    for (std::size_t k = 0; k < found.tangential_displacement.size(); ++k)
    {
      const double t = k * step,
                   exact = mean * (1 - std::exp(-decay * t) *
                                           (std::cos(omega_d * t) + decay / omega_d * std::sin(omega_d * t)));
      worst = std::max(worst, std::abs(found.tangential_displacement[k] - exact));
      largest_swing = std::max(largest_swing, std::abs(exact));
    }
    EXPECT_GT(largest_swing, 1.09 * 2 * std::abs(mean)); // exp(0.196) in the end
    errors.push_back(worst / std::abs(mean));
    std::printf("h = %.0e s: displacement off by %.2e of N mu / k\n", step, errors.back());
  }
  EXPECT_LT(errors[2], 1e-3);
  EXPECT_GT(errors[0] / errors[2], 3.5);
}

// A belt drags a mass that starts at rest: it slides, is caught as it reaches the belt's speed, sticks until k x =
// mu N, and then swings about mu N / k with the amplitude V / omega.
TEST(RoadFriction, StickSlipOnABelt)
{
  const double V = 0.03, caught = std::asin(V / (slip_displacement * omega)) / omega,
               caught_at = slip_displacement * (1 - std::cos(omega * caught)),
               released = caught + (slip_displacement - caught_at) / V;
  const auto exact = [&](const double t)
  {
    if (t < caught)
      return slip_displacement * (1 - std::cos(omega * t));
    if (t < released)
      return caught_at + V * (t - caught);
    return slip_displacement + V / omega * std::sin(omega * (t - released));
  };
  double errors[3], force_errors[3];
  for (const unsigned int k : {0u, 1u, 2u})
  {
    const double h = 1e-4 / (1 << k), end = 0.12;
    const Ride own = run_point(-V, 0, h, end);
    errors[k] = force_errors[k] = 0;
    unsigned int sticking = 0;
    for (std::size_t i = 1; i < own.force.size(); ++i)
    {
      const double t = i * h;
      // of second order: impulses hold the mass against weight and spring
      EXPECT_NEAR(own.force[i] / normal_force, 1, 0.1 * std::pow(300 * h, 2));
      errors[k] = std::max(errors[k], std::abs(own.tangential_displacement[i] - exact(t)));
      // stick: the spring's force; slip: mu N; away from the jump at the capture
      if (std::abs(t - caught) < 2 * h)
        continue;
      const bool sticks = t > caught && t < released;
      sticking += sticks;
      force_errors[k] =
          std::max(force_errors[k],
                   std::abs(own.tangential_force[i] - (sticks ? stiffness * exact(t) : mu * normal_force)));
    }
    EXPECT_GE(own.result.sticking_points, sticking);
    std::printf("stick-slip, h = %.3g s: displacement %.2e, force %.2e (relative)\n", h,
                errors[k] / slip_displacement, force_errors[k] / (mu * normal_force));
    EXPECT_GT(own.result.dissipation, 0);
  }
  EXPECT_LT(errors[0], 5e-4 * slip_displacement);
  EXPECT_LT(errors[2], errors[0] / 8);
  EXPECT_LT(force_errors[0], 1e-3 * mu * normal_force);
}

// A mass that swings on a road at rest loses 4 mu N / k of amplitude in each period, until it sticks.
TEST(RoadFriction, CoulombDamping)
{
  const double begin = 5.3, offset = begin * slip_displacement;
  double errors[3], amplitude_errors[3], energy_errors[3];
  for (const unsigned int k : {0u, 1u, 2u})
  {
    const double h = 1e-4 / (1 << k);
    const Ride own = run_point(0, stiffness * offset, h, 0.14);
    errors[k] = 0;
    for (std::size_t i = 0; i < own.force.size(); ++i)
    {
      // half periods: y swings from -5.3 about -1 ... seen from where the spring and the pull balance
      const double t = i * h;
      const unsigned int half = std::min(3., std::floor(omega * t / pi));
      const double amplitude = begin - 2 * half, side = half % 2 == 0 ? -1 : 1,
                   y = half == 3 ? amplitude * side
                                 : side * (1 + (amplitude - 1) * std::cos(omega * t - half * pi));
      errors[k] =
          std::max(errors[k], std::abs((own.tangential_displacement[i] - offset) / slip_displacement - y));
    }
    const auto y = [&](const double v) { return (v - offset) / slip_displacement; };
    amplitude_errors[k] = std::max(std::abs(y(*std::max_element(own.tangential_displacement.begin(),
                                                                own.tangential_displacement.end())) -
                                            3.3),
                                   std::abs(y(own.tangential_displacement.back()) + 0.7));
    const double energy = 0.5 * stiffness * slip_displacement * slip_displacement * (5.3 * 5.3 - 0.7 * 0.7);
    energy_errors[k] = std::abs(own.result.dissipation / energy - 1);
    std::printf("Coulomb damping, h = %.3g s: displacement %.2e, amplitudes %.2e, energy %.2e (relative)\n",
                h, errors[k], amplitude_errors[k], energy_errors[k]);
    // at rest: the force is what balances
    EXPECT_NEAR(own.tangential_force.back() / (mu * normal_force), -0.7, 1e-3);
  }
  // the instant of a turn is known to a step, what it does to amplitudes and energy is of second order
  for (const unsigned int k : {0u, 1u, 2u})
    EXPECT_LT(errors[k], 1.1 * omega * 1e-4 / (1 << k));
  EXPECT_LT(amplitude_errors[0], 1e-3);
  EXPECT_LT(amplitude_errors[2], amplitude_errors[0] / 4);
  EXPECT_LT(energy_errors[0], 1e-4);
}

TEST(RoadFriction, LawHoldsAtThePointsOfARing)
{
  Tyre tyre;
  tyre.road.sliding_speed = 0.05;
  const Ride own = tyre.run(0.5);
  const double scale = own.result.largest_force;
  unsigned int sticking = 0, forward = 0, backward = 0;
  for (std::size_t k = 3; k < own.force.size(); ++k)
  {
    const double slip =
        (own.tangential_displacement[k] - own.tangential_displacement[k - 3]) / tyre.own.time_step + 0.05;
    EXPECT_LE(std::abs(own.tangential_force[k]), 0.5 * own.force[k] + 1e-9 * scale);
    if (std::abs(own.tangential_force[k]) < 0.5 * own.force[k] - 1e-6 * scale)
    {
      EXPECT_NEAR(slip, 0, 1e-8);
      ++sticking;
    }
    else if (own.force[k] > 0)
    {
      EXPECT_LE(own.tangential_force[k] * slip, 1e-9 * scale);
      ++(slip > 0 ? forward : backward);
    }
  }
  EXPECT_GT(sticking, 50u);
  EXPECT_GT(forward, 50u);
  std::printf("ring: %u steps of points stick, %u slide forward, %u backward\n", sticking, forward, backward);
  EXPECT_GT(own.result.dissipation, 0);
}

// A wheel that slides for good has -mu times the normal impulse; with mu = 0 the normal motion is that without friction.
TEST(RoadFriction, LimitsOfARing)
{
  Tyre tyre;
  tyre.road.sliding_speed = 100;
  const Ride sliding = tyre.run(0.5);
  for (unsigned int i = 0; i < 3; ++i)
    EXPECT_NEAR(sliding.result.tangential_impulse[i] / sliding.result.impulse[i], -0.5, 1e-9);
  const Ride smooth = tyre.run(0.), without = tyre.run(0., false);
  EXPECT_LT(largest_difference(smooth.force, without.force), 1e-9 * largest(without.force));
  EXPECT_LT(largest(smooth.tangential_force), 1e-9 * largest(without.force));
}

TEST(RoadFriction, MethodsAgree)
{
  Tyre tyre;
  tyre.own.end_time = 0.03;
  tyre.road.sliding_speed = 0.05;
  const Ride recursion = tyre.run(0.5);
  for (const char *method : {"direct convolution", "block convolution"})
  {
    tyre.own.method = method;
    const Ride other = tyre.run(0.5);
    EXPECT_LT(largest_difference(recursion.tangential_force, other.tangential_force),
              1e-9 * largest(recursion.force))
        << method;
    EXPECT_LT(largest_difference(recursion.displacement, other.displacement),
              1e-11 * largest(recursion.displacement));
  }
}

TEST(RoadFriction, ConvergesOnARing)
{
  Tyre tyre;
  tyre.road.sliding_speed = 0.05;
  double impulse[3], work[3];
  for (const unsigned int k : {0u, 1u, 2u})
  {
    tyre.own.time_step = 20e-6 / (1 << (2 * k));
    const Ride own = tyre.run(0.5);
    impulse[k] = own.result.tangential_impulse[1];
    work[k] = own.result.dissipation;
    std::printf("ring, h = %.3g s: tangential impulse %.8f N s, friction %.8f J\n", tyre.own.time_step,
                impulse[k], work[k]);
  }
  EXPECT_LT(std::abs(impulse[1] - impulse[2]), 0.5 * std::abs(impulse[0] - impulse[2]));
  EXPECT_NEAR(impulse[0] / impulse[2], 1, 1e-2);
  EXPECT_NEAR(work[0] / work[2], 1, 1e-2);
}

TEST(RoadFriction, RefusesShapesThatRing)
{
  Tyre tyre;
  tyre.ring.residual = false;
  tyre.ring.tread_tangential_stiffness = 0;
  EXPECT_THROW(tyre.run(0.5), InputError);
  tyre.own.force_shape = "constant";
  EXPECT_THROW(tyre.run(0.5), InputError);
  tyre.ring.tread_tangential_stiffness = 1e5;
  tyre.own.end_time = 0.001;
  tyre.run(0.5);
  tyre.own.force_shape = "linear";
  tyre.own.time_step = 5e-3;
  EXPECT_THROW(tyre.run(0.5), InputError);
}

// A speed that varies, but does not, is the constant one: whole runs.
TEST(RoadFriction, SpeedOfConstantValue)
{
  Tyre tyre;
  const Ride constant = tyre.run(0., false);
  tyre.road.speed = 0;
  tyre.road.speed_expression = "80/3.6+0*t";
  const Ride expression = tyre.run(0., false);
  tyre.road.speed_expression.clear();
  tyre.road.speed_table = scratch_folder() + "/constant_speed.csv";
  std::ofstream(tyre.road.speed_table) << "time_s,speed_m_s\n0,22.222222222222222\n0.01,22.222222222222222\n"
                                          "1,22.222222222222222\n";
  const Ride table = tyre.run(0., false);
  EXPECT_LT(largest_difference(constant.force, expression.force), 1e-10 * largest(constant.force));
  EXPECT_LT(largest_difference(constant.force, table.force), 1e-10 * largest(constant.force));
}
