// From growth to the limit cycle: one contact point whose normal and lateral mode couple by friction
// (flutter); the amplitude is bounded by sticking. Growth against the root of the linearisation, the same
// cycle from below, from above and with half the step, its energy.

#include "flutter.h"

#include <vibrocontact/coupled_bodies/stability_roots.h>
#include <vibrocontact/marching/initial_state.h>
#include <vibrocontact/marching/transient_march.h>
#include <vibrocontact/numerics/cycle_measure.h>
#include <vibrocontact/numerics/growth_fit.h>
#include <vibrocontact/numerics/spectrum.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;

namespace
{
  constexpr double friction = Flutter::friction, speed = Flutter::speed;
  constexpr unsigned int n_points = Flutter::n_points, middle = Flutter::middle, lateral = Flutter::lateral;
  const auto drive = Flutter::drive;

  struct Outcome
  {
    DynamicState start, end;
    TransientResult result;
    /// lateral velocity of the mass
    Signal velocity;
    unsigned long stick = 0, open = 0;
  };

  /// @param push lateral velocity added to the equilibrium [m/s]
  Outcome run(const ContactPair &pair, const double push, const double step, const double end,
              const DynamicState *from = nullptr)
  {
    TransientParameters parameters;
    parameters.time_step = step;
    parameters.end_time = end;
    ContactParameters contact;
    contact.friction = friction;
    const ContactSolverParameters solver;
    Outcome run;
    run.start = from ? *from : initial_state(parameters, contact, solver, pair, drive(0));
    DynamicState state = run.start;
    state.time = 0;
    for (unsigned int k = 0; k < 2; ++k)
      state.v[k] += pair.trace(lateral, k) * push;
    run.velocity.begin = run.velocity.step = step;
    run.result = transient(parameters, contact, solver, pair, drive, state,
                           [&](const DynamicState &now, const TransientResult &)
                           {
                             run.velocity.values.push_back(pair.trace(lateral, 0) * now.v[0] +
                                                           pair.trace(lateral, 1) * now.v[1]);
                             run.stick += now.contact.status[middle] == ContactStatus::stick;
                             run.open += now.contact.status[middle] == ContactStatus::open;
                             return true;
                           });
    run.end = state;
    return run;
  }
} // namespace

TEST(LimitCycle, GrowthThenTheSameCycleFromBelowAndAbove)
{
  const ContactPair pair = Flutter::pair(5e-4);
  const double step = 4e-6;
  const Outcome small = run(pair, 1e-4, step, 0.04);
  ASSERT_TRUE(small.result.converged);
  EXPECT_EQ(small.stick, 0u);

  RollingEquilibrium equilibrium;
  equilibrium.contact = small.start.contact;
  equilibrium.friction.assign(n_points, friction);
  equilibrium.speed = speed;
  const auto roots =
      stability_roots(pair, linearised_contact(pair, creep_schemes().front(), equilibrium, {}));
  const StabilityRoot root = *std::max_element(
      roots.begin(), roots.end(), [](const auto &a, const auto &b) { return a.growth < b.growth; });
  ASSERT_GT(root.growth, 10);
  const GrowthFit fit = fit_growths(part(small.velocity, 0.005, 0.04)).at(0);
  std::printf("growth %.4f 1/s at %.3f Hz, root %.4f at %.3f\n", fit.growth, fit.frequency, root.growth,
              root.frequency);
  EXPECT_NEAR(fit.growth / root.growth, 1, 1e-2);
  EXPECT_NEAR(fit.frequency / root.frequency, 1, 1e-3);

  const double end = 0.3;
  const Outcome below = run(pair, 0.03, step, end), above = run(pair, 0.3, step, end),
                halved = run(pair, 0.03, step / 2, end);
  std::vector<double> amplitudes;
  for (const Outcome *one : {&below, &above, &halved})
  {
    const Signal late = part(one->velocity, end / 2, end);
    const double frequency = spectral_peaks(late).at(0).frequency;
    const CycleMeasure cycle = measure_cycle(late, frequency);
    std::printf("%.3f Hz, amplitude %.6f m/s, drift %.1e, spread %.1e, stick %.3f, open %.3f of the time\n",
                frequency, cycle.amplitude, cycle.drift, cycle.spread, one->stick * 1. / one->result.steps,
                one->open * 1. / one->result.steps);
    EXPECT_TRUE(one->result.converged);
    EXPECT_GT(one->stick, 0u);
    EXPECT_LT(std::abs(cycle.drift), 1e-2);
    amplitudes.push_back(cycle.amplitude);
  }
  EXPECT_LT(0.03, amplitudes[0] / 3);
  EXPECT_GT(0.3, amplitudes[0]);
  EXPECT_NEAR(amplitudes[1] / amplitudes[0], 1, 0.02);
  EXPECT_NEAR(amplitudes[2] / amplitudes[0], 1, 0.02);

  // a cycle stores nothing: what the drive gives is heat in contact and damping
  const Outcome cycle = run(pair, 0, step, 0.1, &below.end);
  const EnergyAccount &energy = cycle.result.energy;
  std::printf("creepage %.5f J, friction %.5f, damping %.5f, differences %.2e, imbalance %.2e\n",
              energy.creepage, energy.friction, energy.damping, energy.numerical(), energy.imbalance());
  EXPECT_LT(std::abs(energy.imbalance()), 0.05 * energy.damping);
}
