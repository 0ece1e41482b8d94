// Limit cycles found from unstable roots: the derivative of a period against differences, the cycle of a mass in flutter against
// the march that settles on it, and its Floquet multipliers against what becomes of small disturbances.

#include "cycle_derivatives.h"
#include "flutter.h"

#include <vibrocontact/analyses/limit_cycle/balanced_cycle.h>
#include <vibrocontact/analyses/limit_cycle/cycle_balance.h>
#include <vibrocontact/analyses/limit_cycle/cycle_equations.h>
#include <vibrocontact/analyses/limit_cycle/cycle_period.h>
#include <vibrocontact/marching/initial_state.h>
#include <vibrocontact/marching/transient_march.h>
#include <vibrocontact/numerics/signal.h>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

using namespace vibrocontact;

namespace
{
  /// A mass in flutter, at rest in sliding, with the root that grows.
  struct SlidingMass
  {
    ContactPair pair = Flutter::pair(5e-4);
    TransientParameters transient;
    ContactSections contact;
    ContactSolverParameters solver = solver_of_cycles({});
    Drive drive = Flutter::drive(0);
    DynamicState at_rest;
    StabilityRoot root;

    enum class By
    {
      modes,
      poles,
      /// with gradients, beside a mode
      flowing_poles
    };

    explicit SlidingMass(const std::vector<double> &load = {0, 0}, const By by = By::modes)
    {
      pair.modal_load = load;
      if (by != By::modes)
        Flutter::move_by_poles(pair, by == By::flowing_poles);
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

    CycleMap map(const unsigned int n_steps,
                 const std::vector<unsigned int> &points = {Flutter::middle}) const
    {
      return {transient, contact, solver, pair, drive, at_rest.contact.approach, points, n_steps};
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

TEST(CycleMap, DerivativesAreThoseOfDifferences)
{
  // under a load that stays, on both modes
  SlidingMass scene({50, -30});
  for (const double residual_theta : {1., 0.6})
  {
    scene.transient.residual_theta = residual_theta;
    CycleMap map = scene.map(200), other = scene.map(200);
    const LimitCycle cycle = scene.cycle(map);
    ASSERT_TRUE(cycle.converged) << cycle.message;
    expect_derivatives_of_differences(map, other, cycle, 1e-6);
  }
}

TEST(CycleMap, DerivativesOfPolesAreThoseOfDifferences)
{
  for (const SlidingMass::By by : {SlidingMass::By::poles, SlidingMass::By::flowing_poles})
  {
    const SlidingMass scene({50, -30}, by);
    CycleMap map = scene.map(200), other = scene.map(200);
    const LimitCycle cycle = scene.cycle(map);
    ASSERT_TRUE(cycle.converged) << cycle.message;
    expect_derivatives_of_differences(map, other, cycle, 1e-6);
  }
}

TEST(CycleEquations, HaveNoStepWhereAPeriodWasNotMarched)
{
  const SlidingMass scene;
  CycleMap map = scene.map(200);
  const DenseVector rest = map.pack(scene.at_rest);
  const DenseMatrix linear(map.size(), map.size());
  CycleEquations equations(map, rest, linear, 1e-9);
  std::vector<double> x(rest.begin(), rest.end()), step;
  x.push_back(-1);
  EXPECT_FALSE(solve_by_newton(equations, NewtonSettings(), x).converged);
  EXPECT_FALSE(equations.find_step(true, step));
  EXPECT_FALSE(equations.failure.empty());
}

TEST(CycleOfRoot, IsTheSameByModesAndByPoles)
{
  for (const std::string integrator : {"theta method", "exact propagator"})
  {
    SlidingMass by_modes, by_poles({0, 0}, SlidingMass::By::poles);
    by_modes.transient.integrator = by_poles.transient.integrator = integrator;
    CycleMap map = by_modes.map(200), map_of_poles = by_poles.map(200);
    const LimitCycle cycle = by_modes.cycle(map), found = by_poles.cycle(map_of_poles);
    ASSERT_TRUE(cycle.converged) << cycle.message;
    ASSERT_TRUE(found.converged) << found.message;

    // the cycle by modes in terms of poles: the same steps
    DynamicState state = map.unpack(cycle.state);
    for (unsigned int k = 0; k < 2; ++k)
    {
      const std::complex<double> pole = by_poles.pair.poles[k];
      state.z.push_back((state.v[k] - std::conj(pole) * state.q[k]) / (pole - std::conj(pole)));
    }
    LimitCycle of_poles = cycle;
    of_poles.state = map_of_poles.pack(state);
    judge_cycle(map_of_poles, LimitCycleParameters(), of_poles);
    const double open = distance(map_of_poles.march(of_poles.state, cycle.period, false), of_poles.state) /
                        of_poles.state.l2_norm(),
                 growth = cycle.stability->multipliers.front().growth,
                 growth_of_poles = of_poles.stability->multipliers.front().growth;
    const auto mean_power = [](const SlidingMass &scene, CycleMap &of, const LimitCycle &heard)
    { return listen_to_cycle(of, heard, scene.pair, scene.contact, {}).power_into_body_1.mean(); };
    const double power = mean_power(by_poles, map_of_poles, of_poles) / mean_power(by_modes, map, cycle) - 1;
    std::printf(
        "%s: open by %.1e, growth off by %.1e 1/s, power by %.1e; period of the one from its root by %.1e\n",
        integrator.c_str(), open, growth_of_poles - growth, power, found.period / cycle.period - 1);
    EXPECT_LT(open, 1e-9);
    EXPECT_NEAR(growth_of_poles, growth, 1e-5);
    EXPECT_NEAR(power, 0, 1e-8);
    // another phase, in steps of a 200th of the period
    EXPECT_NEAR(found.period / cycle.period, 1, 1e-6);
  }
}

TEST(CycleOfRoot, IsWhatTheMarchSettlesOn)
{
  const SlidingMass scene;
  CycleMap map = scene.map(200);
  const LimitCycle cycle = scene.cycle(map);
  ASSERT_TRUE(cycle.converged) << cycle.message;
  EXPECT_LT(cycle.residual.value(), 1e-9);
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

TEST(CycleBalance, IsTheSameByModesAndByPoles)
{
  const SlidingMass by_modes, by_poles({0, 0}, SlidingMass::By::poles);
  CycleMap map = by_modes.map(200), map_of_poles = by_poles.map(200);
  const LimitCycle cycle = by_modes.cycle(map);
  ASSERT_TRUE(cycle.converged) << cycle.message;
  const CycleForces by_steps = forces_of_period(map, cycle.state, cycle.period);
  CycleBalance balance = map.balance(by_modes.at_rest, 5, 1e-8),
               of_poles = map_of_poles.balance(by_poles.at_rest, 5, 1e-8);
  std::vector<double> x = balance.unknowns(by_steps.forces, by_steps.approaches, cycle.period);
  ASSERT_TRUE(solve_by_newton(balance, NewtonSettings(), x).converged);
  // what is found by modes is found by poles, whose projections are scaled by 1e-7 differently: damped frequencies
  EXPECT_LT(of_poles.evaluate(x), 1e-6);
  const std::vector<DynamicState> motion = balance.motion(x, 100), moved = of_poles.motion(x, 100);
  double largest = 0, error = 0;
  for (unsigned int t = 0; t < motion.size(); ++t)
    for (unsigned int k = 0; k < 2; ++k)
    {
      // the amplitude of the mode, and its velocity by what the forces feed in
      const std::complex<double> z = moved[t].z[k], pole = by_poles.pair.poles[k];
      const double q = 2 * z.real(),
                   v = 2 * (pole * z + by_poles.pair.pole_load[k] + moved[t].pole_force[k]).real(),
                   w = by_modes.pair.omega[k];
      largest = std::max({largest, std::abs(w * motion[t].q[k]), std::abs(motion[t].v[k])});
      error = std::max({error, std::abs(w * (q - motion[t].q[k])), std::abs(v - motion[t].v[k])});
    }
  std::printf("motion by poles off by %.1e\n", error / largest);
  EXPECT_LT(error, 1e-9 * largest);
}

TEST(CycleBalance, DerivativesAreThoseOfDifferences)
{
  const SlidingMass scene({50, -30});
  // the neighbours of the mass are open, its own point sticks and slides
  CycleMap map = scene.map(200, {1, Flutter::middle, 3});
  const LimitCycle cycle = scene.cycle(map);
  ASSERT_TRUE(cycle.converged) << cycle.message;
  const CycleForces by_steps = forces_of_period(map, cycle.state, cycle.period);
  CycleBalance balance = map.balance(scene.at_rest, 3, 1e-8);
  const std::vector<double> x = balance.unknowns(by_steps.forces, by_steps.approaches, cycle.period);
  const double force = *std::max_element(x.begin(), x.end() - 1);
  for (const bool of_frequency : {false, true})
  {
    balance.evaluate(x);
    const double unit = balance.linearise();
    DenseVector direction(x.size()), by_derivative(x.size());
    for (unsigned int k = 0; k + 1 < direction.size() && !of_frequency; ++k)
      direction[k] = force * std::sin(1. + 5 * k);
    direction[direction.size() - 1] = of_frequency ? x.back() / unit : 0;
    balance.vmult(by_derivative, direction);
    const double length = 1e-7;
    const auto defect_at = [&](const double along)
    {
      std::vector<double> moved = x;
      for (unsigned int k = 0; k < moved.size(); ++k)
        moved[k] += along * direction[k] * (k + 1 == moved.size() ? unit : 1.);
      balance.evaluate(moved);
      return balance.defect();
    };
    DenseVector difference = defect_at(length);
    difference -= defect_at(-length);
    difference /= 2 * length;
    // the phase condition has no defect
    by_derivative[by_derivative.size() - 1] = 0;
    const double size = difference.l2_norm();
    difference -= by_derivative;
    std::printf("derivative by the %s off by %.1e\n", of_frequency ? "frequency" : "forces",
                difference.l2_norm() / size);
    EXPECT_LT(difference.l2_norm(), 1e-5 * size);
  }
}
