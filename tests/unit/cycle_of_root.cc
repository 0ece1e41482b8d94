// Limit cycles found from unstable roots: the derivative of a period against differences, the cycle of a mass in flutter against
// the march that settles on it, and its Floquet multipliers against what becomes of small disturbances.

#include "flutter.h"
#include "scratch_folder.h"

#include <vibrocontact/analyses/limit_cycle/limit_cycle.h>
#include <vibrocontact/analyses/transient/transient.h>
#include <vibrocontact/numerics/signal.h>

#include <boost/math/tools/roots.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>

using namespace vibrocontact;

namespace
{
  /// A mass in flutter, at rest in sliding, with the root that grows.
  struct SlidingMass
  {
    ContactPair pair = Flutter::pair(5e-4);
    TransientParameters transient;
    ContactSections contact;
    ContactSolverParameters solver;
    Drive drive = Flutter::drive(0);
    DynamicState at_rest;
    StabilityRoot root;

    explicit SlidingMass(const std::vector<double> &load = {0, 0})
    {
      pair.modal_load = load;
      contact.first().friction = Flutter::friction;
      at_rest = initial_state(transient, contact, solver, pair, drive);
      RollingEquilibrium equilibrium;
      equilibrium.contact = at_rest.contact;
      equilibrium.friction.assign(Flutter::n_points, Flutter::friction);
      equilibrium.speed = Flutter::speed;
      const auto roots =
          stability_roots(pair, linearised_contact(pair, creep_schemes().front(), equilibrium, {}));
      root = *std::max_element(roots.begin(), roots.end(),
                               [](const auto &a, const auto &b) { return a.growth < b.growth; });
    }

    CycleMap map(const unsigned int n_steps) const
    {
      return {transient, contact, solver, pair, drive, at_rest.contact.approach, {Flutter::middle}, n_steps};
    }

    LimitCycle cycle(CycleMap &map) const
    {
      return find_limit_cycle(map, pair, at_rest, root, LimitCycleParameters());
    }
  };

  double distance(DenseVector a, const DenseVector &b)
  {
    a -= b;
    return a.l2_norm();
  }
} // namespace

namespace
{
  /// The derivatives of a period against differences of marches through `other`.
  /// @param relative size of the differences over that of the state
  void expect_derivatives_of_differences(CycleMap &map, CycleMap &other, const LimitCycle &cycle,
                                         const double relative)
  {
    map.march(cycle.state, cycle.period, true);
    const DenseMatrix monodromy = map.monodromy();
    const DenseVector by_period = map.by_period();
    const double size = relative * cycle.state.l2_norm();
    double largest = 0, error = 0;
    for (unsigned int j = 0; j < map.size(); ++j)
    {
      DenseVector forwards = cycle.state, backwards = cycle.state;
      forwards[j] += size;
      backwards[j] -= size;
      DenseVector difference = other.march(forwards, cycle.period, false);
      difference -= other.march(backwards, cycle.period, false);
      for (unsigned int i = 0; i < map.size(); ++i)
      {
        largest = std::max(largest, std::abs(monodromy(i, j)));
        error = std::max(error, std::abs(difference[i] / (2 * size) - monodromy(i, j)));
      }
    }
    const double longer = 1e-7 * cycle.period;
    DenseVector difference = other.march(cycle.state, cycle.period + longer, false);
    difference -= other.march(cycle.state, cycle.period - longer, false);
    difference /= 2 * longer;
    const double of_period = distance(difference, by_period) / by_period.l2_norm();
    std::printf("monodromy off by %.1e of its largest entry, derivative by the period by %.1e\n",
                error / largest, of_period);
    EXPECT_LT(error, 1e-5 * largest);
    EXPECT_LT(of_period, 1e-5);
  }
} // namespace

TEST(CycleMap, DerivativesAreThoseOfDifferences)
{
  // under a load that stays, on both modes
  const SlidingMass scene({50, -30});
  CycleMap map = scene.map(200), other = scene.map(200);
  const LimitCycle cycle = scene.cycle(map);
  ASSERT_TRUE(cycle.converged) << cycle.message;
  expect_derivatives_of_differences(map, other, cycle, 1e-6);
}

TEST(CycleOfRoot, IsWhatTheMarchSettlesOn)
{
  const SlidingMass scene;
  CycleMap map = scene.map(200);
  const LimitCycle cycle = scene.cycle(map);
  ASSERT_TRUE(cycle.converged) << cycle.message;
  EXPECT_LT(cycle.residual, 1e-9);
  ASSERT_TRUE(cycle.stability->is_stable());

  DenseVector x = cycle.state;
  for (unsigned int p = 0; p < 10; ++p)
    x = map.march(x, cycle.period, false);
  DenseVector motion = cycle.state;
  motion -= map.pack(scene.at_rest);
  const double open = distance(x, cycle.state) / motion.l2_norm();

  TransientParameters transient_parameters = scene.transient;
  transient_parameters.time_step = cycle.period / cycle.n_steps;
  transient_parameters.end_time = 1500.5 * cycle.period;
  transient_parameters.error_estimate = false;
  DynamicState state = map.unpack(cycle.state);
  state.contact.status.clear();
  for (unsigned int k = 0; k < 2; ++k)
    state.v[k] *= 0.9;
  Signal velocity;
  velocity.begin = velocity.step = transient_parameters.time_step;
  transient(transient_parameters, scene.contact, scene.solver, scene.pair, Flutter::drive, state,
            [&](const DynamicState &now, const TransientResult &)
            {
              velocity.values.push_back(scene.pair.trace(Flutter::lateral, 0) * now.v[0] +
                                        scene.pair.trace(Flutter::lateral, 1) * now.v[1]);
              return true;
            });
  // the last 20 periods of the march, and one of the cycle
  std::vector<double> crossings;
  double largest = 0, of_cycle = 0;
  for (std::size_t i = velocity.size() - 20 * cycle.n_steps - 1; i + 1 < velocity.size(); ++i)
  {
    const double a = velocity.values[i], b = velocity.values[i + 1];
    if (a < 0 && b >= 0)
      crossings.push_back(velocity.time(i) + velocity.step * a / (a - b));
    largest = std::max(largest, b);
  }
  map.march(cycle.state, cycle.period, false,
            [&](const DynamicState &now)
            {
              of_cycle = std::max(of_cycle, scene.pair.trace(Flutter::lateral, 0) * now.v[0] +
                                                scene.pair.trace(Flutter::lateral, 1) * now.v[1]);
            });
  const double period = (crossings.back() - crossings.front()) / (crossings.size() - 1);
  std::printf("open by %.1e after 10 periods; period of the march %.1e off, amplitude %.1e\n", open,
              period / cycle.period - 1, largest / of_cycle - 1);
  EXPECT_LT(open, 1e-8);
  EXPECT_NEAR(period / cycle.period, 1, 1e-5);
  EXPECT_NEAR(largest / of_cycle, 1, 2e-4);
}

TEST(CycleOfRoot, MultipliersAreThoseOfSmallDisturbances)
{
  const SlidingMass scene;
  CycleMap map = scene.map(100);
  const LimitCycle cycle = scene.cycle(map);
  ASSERT_TRUE(cycle.converged) << cycle.message;
  const CycleStability &stability = *cycle.stability;
  std::printf("trivial multiplier off by %.1e\n", stability.trivial_error);
  EXPECT_LT(stability.trivial_error, 1e-4);

  // what a larger motion changes from period to period across the cycle, once all that decays faster is gone
  DenseVector x = cycle.state;
  x.sadd(1.001, -0.001, map.pack(scene.at_rest));
  constexpr unsigned int begin = 100, end = 300;
  std::vector<double> changes;
  for (unsigned int p = 0; p <= end; ++p)
  {
    const DenseVector next = map.march(x, cycle.period, false);
    DenseVector change = next, along = map.rate();
    change -= x;
    along /= along.l2_norm();
    change.add(-(change * along), along);
    changes.push_back(change.l2_norm());
    x = next;
  }
  const double growth = std::log(changes[end] / changes[begin]) / ((end - begin) * cycle.period),
               of_multiplier = stability.multipliers.front().growth;
  std::printf("disturbances grow by %.4f 1/s, by the multiplier %.4f\n", growth, of_multiplier);
  EXPECT_NEAR(growth / of_multiplier, 1, 1e-2);
}

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
} // namespace

TEST(CycleOfRoot, FallingFrictionOnABeltIsThatOfTheClosedForm)
{
  const MassOnBelt exact(1e-6);
  ContactPair pair;
  ContactGrid &grid = pair.interface.contacts.only();
  grid.n_x = grid.n_y = 1;
  grid.spacing_x = grid.spacing_y = 1e-3;
  pair.interface.gap = {0};
  pair.trace.reinit(3, 1);
  pair.trace(1, 0) = 1;
  pair.participation.reinit(1, 3);
  pair.omega = {exact.omega};
  pair.damping_ratio = {exact.zeta};
  pair.labels = {"mass:0"};
  pair.body = {1};
  pair.modal_load = {0};
  // the approach is given and nothing but this yields in normal direction: the normal force is constant
  pair.residual.reinit(3, 3);
  for (unsigned int c = 0; c < 3; ++c)
    pair.residual(c, c) = exact.flexibility;
  Drive drive;
  drive.creepage.sliding_x = exact.belt;
  drive.approach = exact.force * pair.residual(0, 0);
  ContactSections contact;
  contact.first().friction_law = "friction curve";
  const std::string curve = scratch_folder() + "/falling.csv";
  std::ofstream(curve) << "slip_speed_m_s, friction\n0, " << exact.mu << "\n0.5, "
                       << exact.mu - 0.5 * exact.fall << "\n";
  contact.first().law_values.set("Friction curve", curve);
  contact.first().read_curves("");
  TransientParameters transient;
  transient.integrator = "exact propagator";
  const ContactSolverParameters solver;
  const DynamicState at_rest = initial_state(transient, contact, solver, pair, drive);
  StabilityRoot root;
  root.growth = (exact.force * exact.fall - 2 * exact.zeta * exact.omega) / 2;
  root.frequency =
      std::sqrt(exact.omega * exact.omega - root.growth * root.growth) / (2 * dealii::numbers::PI);
  root.shape = {1.};

  std::vector<double> of_period, of_largest;
  for (const unsigned int n_steps : {2000u, 4000u})
  {
    const auto new_map = [&]
    { return CycleMap(transient, contact, solver, pair, drive, drive.approach, {0}, n_steps); };
    CycleMap map = new_map();
    LimitCycleParameters parameters;
    parameters.tolerance = 1e-8;
    const LimitCycle cycle = find_limit_cycle(map, pair, at_rest, root, parameters);
    ASSERT_TRUE(cycle.converged) << cycle.message;
    double largest = 0;
    map.march(cycle.state, cycle.period, false,
              [&](const DynamicState &now) { largest = std::max(largest, -now.q[0]); });
    of_period.push_back(cycle.period / exact.period - 1);
    of_largest.push_back(largest / exact.largest - 1);
    std::printf("%u steps: period off by %.2e, largest displacement by %.2e, trivial multiplier by %.1e, "
                "%u iterations\n",
                n_steps, of_period.back(), of_largest.back(), cycle.stability->trivial_error,
                cycle.newton_iterations);
    if (n_steps == 2000)
    {
      CycleMap other = new_map();
      expect_derivatives_of_differences(map, other, cycle, 1e-7);
    }
  }
  // the rate of the residual displacements is a backward difference: errors fall with the step
  for (const std::vector<double> &error : {of_period, of_largest})
  {
    std::printf("halving the step: error times %.3f, extrapolated %.1e\n", error[1] / error[0],
                2 * error[1] - error[0]);
    EXPECT_NEAR(error[1] / error[0], 0.5, 0.02);
    EXPECT_LT(std::abs(2 * error[1] - error[0]), 1.5e-6);
  }
}
