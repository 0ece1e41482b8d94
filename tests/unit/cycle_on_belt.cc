// Limit cycles of a mass on a belt whose friction follows the slip speed, against closed forms and a published number.

#include "belt_scene.h"
#include "cycle_derivatives.h"

#include <vibrocontact/analyses/limit_cycle/balanced_cycle.h>
#include <vibrocontact/analyses/limit_cycle/cycle_errors.h>
#include <vibrocontact/contact/contact_solvers.h>
#include <vibrocontact/marching/step_levels.h>

#include <boost/math/tools/roots.hpp>

#include <functional>

using namespace vibrocontact;

namespace
{
  /// Free motion of 1 kg on a spring and a damper.
  struct FreeMotion
  {
    double decay, omega, a, b;

    FreeMotion(const double stiffness, const double damping, const double u, const double v)
        : decay(damping / 2), omega(std::sqrt(stiffness - decay * decay)), a(u), b((v + decay * u) / omega)
    {
    }
    double u(const double t) const
    {
      return std::exp(-decay * t) * (a * std::cos(omega * t) + b * std::sin(omega * t));
    }
    double v(const double t) const
    {
      return std::exp(-decay * t) *
             ((b * omega - a * decay) * std::cos(omega * t) - (a * omega + b * decay) * std::sin(omega * t));
    }
    double acceleration(const double t) const
    {
      return -2 * decay * v(t) - (omega * omega + decay * decay) * u(t);
    }
  };

  /// The first time after `begin` when f turns from negative to positive.
  double time_of_zero(const std::function<double(double)> &f, const double begin, const double step)
  {
    for (double t = begin;; t += step)
      if (f(t) < 0 && f(t + step) >= 0)
        return boost::math::tools::bisect(f, t, t + step, boost::math::tools::eps_tolerance<double>(50))
            .first;
  }

  /// 1 kg on a spring and a damper rubs on a belt through a spring without mass. Friction falls linearly with the slip speed of
  /// the mass. Its cycle is pieced together from closed forms for sliding and for sticking.
  struct MassOnBelt
  {
    static constexpr double omega = 100, zeta = 5e-3, belt = 0.01, force = 10, mu = 0.4, fall = 0.4;
    double flexibility, period = 0, largest = 0;

    BeltScene scene() const
    {
      return {omega, zeta, flexibility, force, belt, [](const double speed) { return mu - fall * speed; },
              0.005, 100};
    }

    static double drag(const double v) { return force * (mu - fall * std::abs(belt - v)); }

    explicit MassOnBelt(const double flexibility) : flexibility(flexibility)
    {
      const double spring = omega * omega, damper = 2 * zeta * omega, equilibrium = drag(0) / spring;
      double u = drag(belt) / spring, v = belt;
      for (unsigned int k = 0; k < 100; ++k)
      {
        // the end of the spring slides until its slip, which has the rate of its own deflection in it, is zero
        const FreeMotion slides(spring, damper - force * fall, u - equilibrium, v);
        const double quarter = 1.57 / slides.omega;
        const double stop =
            time_of_zero([&](const double t)
                         { return slides.v(t) + flexibility * force * fall * slides.acceleration(t) - belt; },
                         2 * quarter, 1e-4);
        largest = equilibrium + slides.u(time_of_zero([&](const double t) { return -slides.v(t); }, 0, 1e-4));
        u = equilibrium + slides.u(stop);
        v = slides.v(stop);

        // it sticks: the drag grows with the way of the belt until it is as large as friction
        const double stiff = spring + 1 / flexibility, rate = belt / (flexibility * stiff), begin = u,
                     at_begin = drag(v), mean = (at_begin + u / flexibility - damper * rate) / stiff;
        const FreeMotion sticks(stiff, damper, u - mean, v - rate);
        const auto place = [&](const double t) { return mean + rate * t + sticks.u(t); };
        const double slip = time_of_zero(
            [&](const double t)
            { return at_begin + (belt * t - (place(t) - begin)) / flexibility - drag(rate + sticks.v(t)); },
            1e-3, 1e-4);
        u = place(slip);
        v = rate + sticks.v(slip);
        period = stop + slip;
      }
    }
  };

  /// The largest value of equally spaced ones, by the parabola through three.
  double largest_of(const std::vector<double> &values)
  {
    const std::size_t n = values.size(), k = std::max_element(values.begin(), values.end()) - values.begin();
    const double before = values[(k + n - 1) % n], at = values[k], after = values[(k + 1) % n],
                 curvature = before - 2 * at + after;
    return at - (after - before) * (after - before) / (8 * curvature);
  }

  CycleScene scene_about(const BeltScene &scene)
  {
    CycleScene about;
    about.steps = scene.transient;
    about.solver = scene.solver;
    about.contacts = scene.contact;
    about.pair = std::make_shared<const ContactPair>(scene.pair);
    about.shapes = std::make_shared<const PatchShapes>(shapes_of_steps(scene.pair));
    about.drive = scene.drive;
    about.at_rest = scene.at_rest;
    return about;
  }

  /// Hears the velocity of the mass.
  Probe probe_of_mass()
  {
    Probe mass;
    mass.name = "mass";
    mass.shape = {-1};
    return mass;
  }

  /// A cycle by harmonic balance.
  std::vector<BalancedCycle> balanced(const BeltScene &scene, CycleMap &map, const LimitCycle &cycle,
                                      const std::vector<unsigned int> &harmonics)
  {
    LimitCycleParameters parameters;
    parameters.harmonics = harmonics;
    return balance_cycle(scene_about(scene), cycle, forces_of_period(map, cycle.state, cycle.period),
                         parameters, {probe_of_mass()});
  }

  /// What a halved step makes of errors: times 2^-order; the extrapolation of two steps is off by less than a bound.
  void expect_order(const unsigned int order, const std::vector<double> &error, const double bound)
  {
    const double extrapolated = error[1] + (error[1] - error[0]) / (std::pow(2., order) - 1);
    std::printf("halving the step: error times %.3f, extrapolated %.1e\n", error[1] / error[0], extrapolated);
    EXPECT_NEAR(error[1] / error[0], std::pow(0.5, order), 0.02);
    EXPECT_LT(std::abs(extrapolated), bound);
  }
} // namespace

TEST(CycleOnBelt, OfFallingFrictionIsThatOfTheClosedForm)
{
  const MassOnBelt exact(1e-6);
  const BeltScene scene = exact.scene();
  std::vector<double> of_period, of_largest;
  for (const unsigned int n_steps : {2000u, 4000u})
  {
    CycleMap map = scene.map(n_steps);
    const LimitCycle cycle = scene.cycle(map);
    ASSERT_TRUE(cycle.converged) << cycle.message;
    std::vector<double> displacements;
    map.march(cycle.state, cycle.period, false,
              [&](const DynamicState &now) { displacements.push_back(-now.q[0]); });
    of_period.push_back(cycle.period / exact.period - 1);
    of_largest.push_back(largest_of(displacements) / exact.largest - 1);
    std::printf("%u steps: period off by %.2e, largest displacement by %.2e, trivial multiplier by %.1e, "
                "%u iterations\n",
                n_steps, of_period.back(), of_largest.back(), cycle.stability->trivial_error,
                cycle.newton_iterations);
    if (n_steps == 2000)
    {
      CycleMap other = scene.map(n_steps);
      expect_derivatives_of_differences(map, other, cycle, 1e-7);
    }
  }
  // the rate of the residual displacements is a backward difference: errors fall with the step
  for (const std::vector<double> &error : {of_period, of_largest})
    expect_order(1, error, 1.5e-6);
}

TEST(CycleOnBelt, TheErrorOfItsStepsIsEstimated)
{
  const MassOnBelt exact(1e-6);
  BeltScene scene = exact.scene();
  const Probe mass = probe_of_mass();
  const auto expect_near = [](const char *const what, const double estimated, const double error)
  {
    std::printf("  %s off by %.2e, estimated %.2e\n", what, error, estimated);
    EXPECT_GT(estimated, 0.6 * error);
    EXPECT_LT(estimated, 2 * error);
  };
  for (const double theta : {1., 0.6})
  {
    scene.transient.residual_theta = theta;
    CycleMap fine_map = scene.map(8000);
    const LimitCycle fine = scene.cycle(fine_map);
    ASSERT_TRUE(fine.converged) << fine.message;
    const double amplitude =
        listen_to_cycle(fine_map, fine, scene.pair, scene.contact, {mass}).main_signal().amplitude();
    for (const unsigned int n_steps : {500u, theta == 1 ? 1001u : 2000u})
    {
      CycleMap map = scene.map(n_steps);
      const LimitCycle cycle = scene.cycle(map);
      ASSERT_TRUE(cycle.converged) << cycle.message;
      const CyclePeriod period = listen_to_cycle(map, cycle, scene.pair, scene.contact, {mass});
      const CycleErrors errors =
          errors_of_steps(scene_about(scene), {}, map.points_that_may_touch(), cycle, period, {mass});
      EXPECT_EQ(errors.failure, "");
      EXPECT_EQ(errors.n_steps, (n_steps + 1) / 2);
      EXPECT_EQ(errors.signal, "mass_velocity_m_s");
      std::printf("residual theta %.1f, %u steps:\n", theta, n_steps);
      expect_near("frequency", errors.frequency, std::abs(exact.period / cycle.period - 1));
      expect_near("amplitude", errors.amplitude, std::abs(period.main_signal().amplitude() / amplitude - 1));
    }
  }
}

TEST(CycleOnBelt, WithAResidualThetaNearAHalfIsMoreExact)
{
  const MassOnBelt exact(1e-6);
  BeltScene scene = exact.scene();
  std::vector<double> errors;
  for (const double theta : {1., 0.6, 0.55})
  {
    scene.transient.residual_theta = theta;
    CycleMap map = scene.map(500);
    const LimitCycle cycle = scene.cycle(map);
    ASSERT_TRUE(cycle.converged) << cycle.message;
    errors.push_back(cycle.period / exact.period - 1);
    std::printf(
        "residual theta %.2f: period off by %.2e, trivial multiplier by %.1e, %u iterations, last %.1e\n",
        theta, errors.back(), cycle.stability->trivial_error, cycle.newton_iterations,
        cycle.residual.value());
    if (theta < 1)
    {
      CycleMap other = scene.map(500);
      expect_derivatives_of_differences(map, other, cycle, 1e-7);
    }
  }
  EXPECT_NEAR(errors[1] / errors[0], 0.2, 0.05);
  EXPECT_NEAR(errors[2] / errors[0], 0.1, 0.05);

  // friction follows the slip of the mass, without the rate: however short the steps, falling friction lets no rate grow
  scene.transient.residual_theta = 0.6;
  CycleMap map = scene.map(8000);
  const double h = exact.period / 8000;
  ASSERT_GT(MassOnBelt::force * MassOnBelt::fall * exact.flexibility / (0.6 * h), 0.8);
  const LimitCycle cycle = scene.cycle(map);
  ASSERT_TRUE(cycle.converged) << cycle.message;
  const double error = cycle.period / exact.period - 1;
  std::printf("8000 steps: period off by %.2e, largest growth %.3f 1/s\n", error,
              cycle.stability->multipliers.empty() ? 0. : cycle.stability->multipliers.front().growth);
  EXPECT_NEAR(error / errors[1], 500. / 8000, 0.02);
}

namespace
{
  /// Mean of the last ten periods of a march of 4 s, in which the motion has settled.
  double period_of_march(const BeltScene &scene, const double h, const double residual_theta)
  {
    ContactStepper stepper(scene.pair, creep_schemes().front(), scene.contact,
                           modal_steps(scene.transient, scene.pair, h), h, 0, {}, nullptr, residual_theta);
    const auto solver = create_contact_solver(scene.solver);
    DynamicState state = scene.at_rest;
    state.q[0] += 1e-4;
    std::vector<double> turns;
    for (double before = state.v[0]; state.time < 4; before = state.v[0])
    {
      stepper.advance(state, scene.drive, *solver);
      if (before > 0 && state.v[0] <= 0)
        turns.push_back(state.time - h * state.v[0] / (state.v[0] - before));
    }
    return (turns.back() - turns.at(turns.size() - 11)) / 10;
  }
} // namespace

TEST(StepsOnBelt, WithAResidualThetaNearAHalfAreMoreExact)
{
  const MassOnBelt exact(1e-6);
  const BeltScene scene = exact.scene();
  std::vector<double> errors;
  for (const double theta : {1., 0.6})
  {
    errors.push_back(period_of_march(scene, 1e-4, theta) / exact.period - 1);
    std::printf("residual theta %.1f: period off by %.2e\n", theta, errors.back());
  }
  // (theta - 1/2) h times the derivative of the rate
  EXPECT_NEAR(errors[0], 1.6e-4, 0.2e-4);
  EXPECT_NEAR(errors[1] / errors[0], 0.2, 0.05);
}

namespace
{
  /// Friction force of the velocity v: v - v^3 / 3, van der Pol's oscillator with epsilon = 1 for v.
  constexpr double rayleigh_belt = 2.6, rayleigh_force = 20, rayleigh_period = 6.66328686,
                   rayleigh_amplitude = 2.00861986;
  BeltScene rayleigh_scene()
  {
    return {1,
            0,
            1e-6,
            rayleigh_force,
            rayleigh_belt,
            [](const double speed)
            {
              const double v = rayleigh_belt - speed;
              return 0.3 + (v - v * v * v / 3) / rayleigh_force;
            },
            2e-4,
            26001};
  }
} // namespace

TEST(CycleOnBelt, OfRayleighsOscillatorIsThePublishedOne)
{
  const BeltScene scene = rayleigh_scene();
  std::vector<double> of_period, of_amplitude;
  for (const unsigned int n_steps : {500u, 1000u})
  {
    CycleMap map = scene.map(n_steps);
    const LimitCycle cycle = scene.cycle(map);
    ASSERT_TRUE(cycle.converged) << cycle.message;
    std::vector<double> velocities;
    map.march(cycle.state, cycle.period, false,
              [&](const DynamicState &now) { velocities.push_back(-now.v[0]); });
    of_period.push_back(cycle.period / rayleigh_period - 1);
    of_amplitude.push_back(largest_of(velocities) / rayleigh_amplitude - 1);
    std::printf("%u steps: period off by %.2e, amplitude by %.2e, growth of disturbances %.6f 1/s, "
                "%u iterations\n",
                n_steps, of_period.back(), of_amplitude.back(), cycle.stability->multipliers.front().growth,
                cycle.newton_iterations);
  }
  for (const std::vector<double> &error : {of_period, of_amplitude})
    expect_order(2, error, 1e-6);
}

TEST(CycleOnBelt, IsTheSameFromAnotherRoot)
{
  const auto period_from = [](const BeltScene &scene, const unsigned int n_steps)
  {
    CycleMap map = scene.map(n_steps);
    const LimitCycle cycle = scene.cycle(map);
    EXPECT_TRUE(cycle.converged) << cycle.message;
    return listen_to_cycle(map, cycle, scene.pair, scene.contact, {probe_of_mass()});
  };
  BeltScene scene = rayleigh_scene();
  const CyclePeriod first = period_from(scene, 500);
  scene.root.frequency *= 1.01;
  EXPECT_TRUE(first.is_same(period_from(scene, 495)));
  EXPECT_FALSE(first.is_same(period_from(MassOnBelt(1e-6).scene(), 500)));
  CyclePeriod louder = first;
  for (double &value : louder.probes.front().values)
    value *= 1.02;
  EXPECT_FALSE(first.is_same(louder));
}

TEST(CycleOnBelt, FewStepsAreComparedWithTwiceAsMany)
{
  const BeltScene scene = rayleigh_scene();
  const Probe mass = probe_of_mass();
  for (const unsigned int n_steps : {14u, 15u, 30u})
  {
    CycleMap map = scene.map(n_steps);
    LimitCycleParameters parameters;
    parameters.n_multipliers = 0;
    const LimitCycle cycle = find_limit_cycle(map, scene.pair, scene.at_rest, scene.root, parameters);
    ASSERT_TRUE(cycle.converged) << cycle.message;
    const CyclePeriod period = listen_to_cycle(map, cycle, scene.pair, scene.contact, {mass});
    const auto errors_with = [&](const unsigned int max_iterations)
    {
      parameters.max_newton_iterations = max_iterations;
      return errors_of_steps(scene_about(scene), parameters, map.points_that_may_touch(), cycle, period,
                             {mass});
    };
    const CycleErrors errors = errors_with(20);
    const double error = std::abs(rayleigh_period / cycle.period - 1);
    std::printf("%u steps: frequency off by %.2e, estimated from %u steps %.2e\n", n_steps, error,
                errors.n_steps, errors.frequency);
    EXPECT_EQ(errors.failure, "");
    EXPECT_EQ(errors.n_steps, n_steps < 15 ? 2 * n_steps : (n_steps + 1) / 2);
    // of second order here: too much by 1.5 from twice as many steps, by 3 from half as many
    EXPECT_GT(errors.frequency, error);
    EXPECT_LT(errors.frequency, 4 * error);
    EXPECT_NE(errors_with(0).failure, "");
  }
}

TEST(CycleOnBelt, ByHarmonicBalanceIsThePublishedOne)
{
  const BeltScene scene = rayleigh_scene();
  CycleMap map = scene.map(500);
  const LimitCycle cycle = scene.cycle(map);
  ASSERT_TRUE(cycle.converged) << cycle.message;
  double before = 1;
  for (const BalancedCycle &one : balanced(scene, map, cycle, {3, 7, 15, 31}))
  {
    ASSERT_TRUE(one.converged) << one.message;
    const double of_period = std::abs(one.period / rayleigh_period - 1),
                 of_amplitude = std::abs(largest_of(one.motion->probes[0].values) / rayleigh_amplitude - 1);
    std::printf("%u harmonics: period off by %.2e, amplitude by %.2e, %u iterations, %lu products\n",
                one.n_harmonics, of_period, of_amplitude, one.newton_iterations, one.n_products);
    EXPECT_LT(of_amplitude, 0.1 * before);
    before = of_amplitude;
    EXPECT_LT(one.newton_iterations, 8u);
    if (one.n_harmonics == 31)
    {
      EXPECT_LT(of_period, 1e-6);
      EXPECT_LT(of_amplitude, 1e-6);
    }
  }
}

TEST(CycleOnBelt, ByHarmonicBalanceIsTheSameUnderAGivenNormalForce)
{
  BeltScene scene = rayleigh_scene();
  CycleMap map = scene.map(500);
  const LimitCycle cycle = scene.cycle(map);
  ASSERT_TRUE(cycle.converged) << cycle.message;
  const BalancedCycle held = balanced(scene, map, cycle, {15}).at(0);
  scene.drive.normal_force = rayleigh_force;
  scene.run_at(rayleigh_belt, -1 / rayleigh_force);
  CycleMap under_force = scene.map(500);
  const LimitCycle same = scene.cycle(under_force);
  ASSERT_TRUE(same.converged) << same.message;
  const BalancedCycle given = balanced(scene, under_force, same, {15}).at(0);
  ASSERT_TRUE(held.converged && given.converged) << held.message << given.message;
  std::printf("period under a given force %.2e off, %u iterations\n", given.period / held.period - 1,
              given.newton_iterations);
  EXPECT_NEAR(given.period / held.period, 1, 1e-8);
  for (const double normal_force : given.motion->forces[0].values)
    EXPECT_NEAR(normal_force / rayleigh_force, 1, 1e-9);
}

TEST(CycleOnBelt, ByHarmonicBalanceComesToTheClosedFormOfStickAndSlip)
{
  const MassOnBelt exact(1e-6);
  const BeltScene scene = exact.scene();
  CycleMap map = scene.map(500);
  const LimitCycle cycle = scene.cycle(map);
  ASSERT_TRUE(cycle.converged) << cycle.message;
  double before = 1, sticks = 0, sticks_by_balance = 0;
  map.march(cycle.state, cycle.period, false,
            [&](const DynamicState &now)
            { sticks += (now.contact.status[0] == ContactStatus::stick) / double(map.n_steps()); });
  for (const BalancedCycle &one : balanced(scene, map, cycle, {5, 20, 80}))
  {
    ASSERT_TRUE(one.converged) << one.message;
    const double of_period = std::abs(one.period / exact.period - 1);
    std::printf("%u harmonics: period off by %.2e, %u iterations, %lu products\n", one.n_harmonics, of_period,
                one.newton_iterations, one.n_products);
    EXPECT_LT(of_period, 0.5 * before);
    before = of_period;
    sticks_by_balance = one.motion->stick_points.mean();
  }
  EXPECT_LT(before, 1e-4);
  std::printf("sticks for %.3f of a period, by steps %.3f\n", sticks_by_balance, sticks);
  EXPECT_GT(sticks, 0.05);
  EXPECT_NEAR(sticks_by_balance, sticks, 0.01);
}
