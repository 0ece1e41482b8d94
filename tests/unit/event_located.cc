// The oscillator on a sine against the closed forms (doc/theory.md, corrections to the tyre paper).
#include "pi.h"

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/propagators/event_located.h>
#include <vibrocontact/propagators/propagator.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;

namespace
{
  constexpr double mass = 1, stiffness = 4e5, zeta = 0.02, gravity = 9.81, amplitude = 5e-3,
                   wavelength = 0.025;
  const double omega = std::sqrt(stiffness / mass), omega_d = omega * std::sqrt(1 - zeta * zeta);
  BodyInContact oscillator()
  {
    DenseMatrix trace(1, 1);
    trace(0, 0) = 1 / std::sqrt(mass);
    return by_poles({{omega}, {zeta}, trace, {-gravity * std::sqrt(mass)}, DenseMatrix(), {}});
  }

  Road sine_road(const double speed, const double end_time)
  {
    RoadParameters parameters;
    parameters.profile = "expression";
    parameters.expression = "5e-3*sin(2*pi*s/0.025)";
    parameters.speed = speed;
    return Road(parameters, {0.}, {0.}, end_time);
  }

  /// The same motion by closed forms: contact force P sin(w t + delta) + M g, free flight of the oscillator.
  struct ClosedForm
  {
    explicit ClosedForm(const double speed) : w(2 * pi * speed / wavelength)
    {
      const std::complex<double> force =
          amplitude * std::complex<double>(stiffness - mass * w * w, 2 * zeta * omega * mass * w);
      P = std::abs(force);
      delta = std::arg(force);
    }
    double road(const double t) const { return amplitude * std::sin(w * t); }
    double road_rate(const double t) const { return amplitude * w * std::cos(w * t); }
    double force(const double t) const { return P * std::sin(w * t + delta) + mass * gravity; }
    /// free flight that began at t0 with u0, v0; displacement and rate
    std::pair<double, double> flight(const double t0, const double u0, const double v0, const double t) const
    {
      const double a = u0 + mass * gravity / stiffness, b = (v0 + zeta * omega * a) / omega_d, s = t - t0;
      const double e = std::exp(-zeta * omega * s), c = std::cos(omega_d * s), d = std::sin(omega_d * s);
      return {e * (a * c + b * d) - mass * gravity / stiffness,
              e * ((-zeta * omega * a + omega_d * b) * c - (zeta * omega * b + omega_d * a) * d)};
    }
    double w, P, delta;
  };

  double bisect(const std::function<double(double)> &f, double a, double b)
  {
    const bool negative = f(a) < 0;
    for (unsigned int k = 0; k < 200; ++k)
    {
      const double x = 0.5 * (a + b);
      ((f(x) < 0) == negative ? a : b) = x;
    }
    return 0.5 * (a + b);
  }

  struct Motion
  {
    std::vector<ContactEvent> impacts, releases;
    std::vector<double> impulse;
    double u = 0, u_015 = 0;
    /// from the road while closed
    double distance = 0;
  };

  Motion move(const double speed, const double end, const double step)
  {
    const BodyInContact model = oscillator();
    const Road road = sine_road(speed, end);
    EventLocated motion(model, state_at_rest(model), road, step);
    Motion result;
    motion.advance(end,
                   [&](const EventLocated::Piece &piece)
                   {
                     if (piece.begin <= 0.15 && piece.end > 0.15)
                       result.u_015 = piece.u(0, 0.15);
                     result.u = piece.u(0, piece.end);
                     for (unsigned int k = 0; k <= 16 && piece.closed[0]; ++k)
                     {
                       const double t = piece.begin + (piece.end - piece.begin) * k / 16;
                       result.distance =
                           std::max(result.distance, std::abs(piece.u(0, t) - road.height(0, t)));
                     }
                   });
    result.impacts = motion.impacts;
    result.releases = motion.releases;
    result.impulse = motion.impulse;
    return result;
  }
} // namespace

TEST(EventLocated, KnownEvents)
{
  EXPECT_NEAR(ClosedForm(0.1).P, 1996.84425720, 1e-8);
  for (const double step : {1e-2, 1e-3, 1.7e-4})
  {
    const Motion motion = move(0.1, 0.4, step);
    ASSERT_GE(motion.impacts.size(), 2u);
    ASSERT_GE(motion.releases.size(), 2u);
    EXPECT_EQ(motion.impacts[0].time, 0);
    EXPECT_NEAR(motion.impacts[0].impulse, 0.12566370614, 1e-11);
    EXPECT_NEAR(motion.releases[0].time, 0.125132127434, 1e-12);
    EXPECT_NEAR(motion.impacts[1].time, 0.249907241793, 1e-12);
    EXPECT_NEAR(motion.impacts[1].impulse, 0.1012085785, 1e-10);
    // periodic after the first lift-off
    EXPECT_NEAR(motion.releases[1].time, 0.25 + 0.125132127434, 1e-12);
    EXPECT_NEAR(motion.u_015, -2.78845687e-5, 1e-13);
  }
}

// Every event against bisection of the closed forms, V0 = 0.1, 1, 2, 3 m/s.
TEST(EventLocated, OscillatorAtAllSpeeds)
{
  for (const double speed : {0.1, 1., 2., 3.})
  {
    const ClosedForm exact(speed);
    const double end = speed < 1 ? 1 : 0.3;
    const Motion motion = move(speed, end, 1e-2);
    EXPECT_LT(motion.distance, 1e-12) << speed;
    double t = 0, u = 0, v = 0;
    unsigned int impact = 0, release = 0;
    while (true)
    {
      ASSERT_LT(impact, motion.impacts.size());
      EXPECT_NEAR(motion.impacts[impact].time, t, 1e-9) << speed;
      EXPECT_NEAR(motion.impacts[impact].impulse, mass * (exact.road_rate(t) - v), 1e-8) << speed;
      ++impact;
      double lift = t;
      if (exact.force(t) > 0)
      {
        const double small = 1e-3 / exact.w;
        while (exact.force(lift + small) > 0)
          lift += small;
        lift = bisect([&](const double s) { return exact.force(s); }, lift, lift + small);
      }
      if (lift > end - 1e-9)
        break;
      ASSERT_LT(release, motion.releases.size());
      EXPECT_NEAR(motion.releases[release].time, lift, 1e-9) << speed;
      ++release;
      const double t0 = lift, u0 = exact.road(lift), v0 = exact.road_rate(lift);
      const auto gap = [&](const double s) { return exact.flight(t0, u0, v0, s).first - exact.road(s); };
      double s = t0 + 1e-6;
      while (gap(s) >= 0 && s < end)
        s += 1e-6;
      if (s >= end)
      {
        EXPECT_NEAR(motion.u, exact.flight(t0, u0, v0, end).first, 1e-12) << speed;
        break;
      }
      t = bisect(gap, s - 1e-6, s);
      std::tie(u, v) = exact.flight(t0, u0, v0, t);
    }
    EXPECT_EQ(motion.impacts.size(), impact);
    EXPECT_EQ(motion.releases.size(), release);
  }
}

// Three rigid points under a symmetric body: the outer ones touch together, and impulses balance momentum.
TEST(EventLocated, ThreePointsKeepTheRoad)
{
  const unsigned int n_modes = 5;
  DenseMatrix trace(3, n_modes);
  std::vector<double> w, damping, load;
  for (unsigned int k = 0; k < n_modes; ++k)
  {
    w.push_back(400 + 350 * k);
    damping.push_back(0.05);
    load.push_back(k == 0 ? -30 : 0);
    for (unsigned int i = 0; i < 3; ++i)
      trace(i, k) = std::cos((k + 0.5) * (i + 0.3)) + (k == 0 ? 1.5 : 0);
  }
  const BodyInContact model = by_poles({w, damping, trace, load, DenseMatrix(), {}});
  RoadParameters parameters;
  parameters.profile = "expression";
  parameters.expression = "1e-3*sin(2*pi*s/0.1)";
  parameters.speed = 2;
  parameters.indentation = 2e-4;
  parameters.loading_time = 0.02;
  const Road road(parameters, {-0.01, 0, 0.01}, {1e-5, 0, 1e-5}, 0.2);
  double displacement[2][3], impulse[2][3];
  for (const unsigned int k : {0u, 1u})
  {
    EventLocated motion(model, state_at_rest(model), road, k == 0 ? 2e-4 : 7e-5);
    double deepest = 0, most_negative = 0, largest = 0;
    motion.advance(0.2,
                   [&](const EventLocated::Piece &piece)
                   {
                     for (double x = 0; x <= 1; x += 0.25)
                       for (unsigned int i = 0; i < 3; ++i)
                       {
                         const double t = piece.begin + x * (piece.end - piece.begin);
                         deepest = std::min(deepest, piece.u(i, t) - road.height(i, t));
                         most_negative = std::min(most_negative, piece.q(i, t));
                         largest = std::max(largest, piece.q(i, t));
                         displacement[k][i] = piece.u(i, piece.end);
                       }
                   });
    EXPECT_GT(deepest, -1e-12);
    EXPECT_GT(most_negative, -1e-7 * largest);
    EXPECT_GT(motion.impacts.size(), 3u);
    for (unsigned int i = 0; i < 3; ++i)
      impulse[k][i] = motion.impulse[i];
  }
  for (unsigned int i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(displacement[0][i], displacement[1][i], 1e-9);
    EXPECT_NEAR(impulse[0][i], impulse[1][i], 1e-6 * impulse[0][1]);
  }
}

TEST(EventLocated, RefusesWhatIsNotRigid)
{
  BodyInContact model = oscillator();
  model.residual.reinit(1, 1);
  model.residual(0, 0) = 1e-6;
  const Road road = sine_road(0.1, 1);
  EXPECT_THROW(EventLocated(model, state_at_rest(model), road, 1e-3), InputError);
  model = oscillator();
  model.right(0, 0) *= std::complex<double>(1, 0.1);
  EXPECT_THROW(EventLocated(model, state_at_rest(model), road, 1e-3), InputError);
}

// The deterministic road's known values; a varying speed of constant value is the constant speed.
TEST(Road, SpectrumAndSpeed)
{
  RoadParameters parameters;
  parameters.profile = "ISO 8608";
  parameters.speed = 10;
  const Road road(parameters, {0., 0.01}, {0., 0.}, 1);
  EXPECT_NEAR(road.height(0, 0), -2.07366e-4, 1e-9);
  EXPECT_NEAR(road.height(1, 0), 2.67944e-5, 1e-10);
  double square = 0;
  for (unsigned int k = 0; k < 100000; ++k)
    square += std::pow(road.height(0, 1e-5 * k), 2) / 100000;
  EXPECT_NEAR(std::sqrt(square), 0.281e-3, 0.5e-6);
  parameters.speed = 0;
  parameters.speed_expression = "10+0*t";
  const Road same(parameters, {0., 0.01}, {0., 0.}, 1);
  for (double t = 0; t <= 1; t += 0.01)
  {
    EXPECT_NEAR(same.height(1, t), road.height(1, t), 1e-13);
    EXPECT_NEAR(same.at(0, t).second, road.at(0, t).second, 1e-9 * 300 * 300 * 10);
  }
}
