// Bodies by modes and by poles: receptances, impulse responses and free fall against their closed forms.
#include "matrix_difference.h"

#include <vibrocontact/analyses/modal_convolution/static_load.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/bodies/ring_poles.h>
#include <vibrocontact/propagators/propagator_types.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;

namespace
{
  BodyInContact oscillator(const double zeta)
  {
    DenseMatrix trace(1, 1), residual(1);
    trace(0, 0) = 0.5; // mass 4 kg
    residual(0, 0) = 1e-6;
    return by_poles({{300.}, {zeta}, trace, {}, residual, {"bounce"}});
  }
} // namespace

TEST(BodyInContact, ReceptanceOfAnOscillator)
{
  for (const double zeta : {0., 0.02, 0.7, 1., 1.5})
  {
    const BodyInContact model = oscillator(zeta);
    for (const double w : {10., 250., 1000.})
    {
      const std::complex<double> exact =
          0.25 / (std::complex<double>(300. * 300. - w * w, 2 * zeta * 300. * w)) + 1e-6;
      EXPECT_NEAR(std::abs(receptance(model, w)(0, 0) / exact - 1.), 0, zeta == 1. ? 1e-6 : 1e-12) << zeta;
    }
  }
}

TEST(BodyInContact, ImpulseResponseOfAnOscillator)
{
  const double wd = 300. * std::sqrt(1 - 0.02 * 0.02), t = 0.013;
  EXPECT_NEAR(impulse_response(oscillator(0.02), t)(0, 0) * wd / 0.25 / std::exp(-6. * t), std::sin(wd * t),
              1e-12);
  EXPECT_NEAR(initial_derivative(oscillator(0.02), 0)(0, 0), 0, 1e-15);
  EXPECT_NEAR(initial_derivative(oscillator(0.02), 1)(0, 0), 0.25, 1e-12);
  EXPECT_NEAR(initial_derivative(oscillator(1.5), 1)(0, 0), 0.25, 1e-12);
}

namespace
{
  /// Two masses of 2 and 3 kg on one spring, in free fall: rows are their motions up.
  BodyInContact two_masses(const double zeta)
  {
    const double m = 2, M = 3, k = 5e4, omega = std::sqrt(k * (1 / m + 1 / M));
    BodyInContact body;
    body.omega = {0., omega};
    body.damping_ratio = {0., zeta};
    body.trace.reinit(2, 2);
    body.trace(0, 0) = body.trace(1, 0) = 1 / std::sqrt(m + M);
    body.trace(0, 1) = std::sqrt(M / (m * (m + M)));
    body.trace(1, 1) = -std::sqrt(m / (M * (m + M)));
    body.modal_load = {-9.81 * std::sqrt(m + M), 0.};
    body.residual.reinit(2, 2);
    body.labels = {"whole", "apart"};
    return body;
  }
} // namespace

TEST(BodyInContact, ModesAndPolesTogetherAreTheirSum)
{
  DenseMatrix trace(2, 3), residual(2, 2);
  for (unsigned int k = 0; k < 3; ++k)
    for (unsigned int i = 0; i < 2; ++i)
      trace(i, k) = std::sin(1. + i + 2 * k);
  residual(0, 0) = residual(1, 1) = 1e-6;
  const BodyInContact modes{{20., 300., 800.}, {0.01, 1.3, 0.2}, trace,
                            {1., 2., 3.},      residual,         {"a", "b", "c"}};
  // the last mode as a pole
  BodyInContact both = by_poles(modes);
  const BodyInContact all = both;
  both.omega = {20., 300.};
  both.damping_ratio = {0.01, 1.3};
  both.trace.reinit(2, 2);
  both.modal_load = {1., 2.};
  both.labels = {"a", "b", "c"};
  both.right.reinit(2, 1);
  both.left.reinit(2, 1);
  both.poles = {all.poles.back()};
  both.pole_load = {all.pole_load.back()};
  for (unsigned int i = 0; i < 2; ++i)
  {
    both.trace(i, 0) = trace(i, 0);
    both.trace(i, 1) = trace(i, 1);
    both.right(i, 0) = all.right(i, 3);
    both.left(i, 0) = all.left(i, 3);
  }
  for (const double omega : {0., 15., 310., 2000.})
  {
    EXPECT_LT(difference(receptance(all, omega), receptance(modes, omega)), 1e-13);
    EXPECT_LT(difference(receptance(both, omega), receptance(modes, omega)), 1e-13);
  }
  const BodyInContact again = by_poles(both);
  EXPECT_EQ(again.poles, all.poles);
  EXPECT_EQ(again.pole_load, all.pole_load);
  EXPECT_EQ(again.labels, all.labels);
}

// A free body: a push, then its weight alone. The centre of gravity follows the parabola, the distance of the masses rings.
TEST(BodyInContact, FreeBodyFallsAndRingsInEveryResponse)
{
  const double zeta = 0.03, h = 1e-4, push = 40, M = 5;
  const unsigned int n_steps = 3000;
  const BodyInContact body = two_masses(zeta), poles = by_poles(body);
  for (const ForceInterpolation interpolation :
       {ForceInterpolation::impulse, ForceInterpolation::constant, ForceInterpolation::linear})
    for (const PropagatorType &method : propagator_types())
    {
      PropagatorSettings settings;
      settings.time_step = h;
      settings.interpolation = interpolation;
      settings.n_steps = n_steps;
      const auto propagator = create_propagator(method.name, poles, state_at_rest(poles), settings);
      double worst_mean = 0, worst_apart = 0;
      for (unsigned int k = 0; k < n_steps; ++k)
      {
        // an impulse in the first step
        const double q[2] = {k == 0 ? push : 0., 0.}, t = (k + 1) * h;
        const double *const free = propagator->free_displacement();
        double u[2];
        for (unsigned int i = 0; i < 2; ++i)
          u[i] = free[i] + propagator->compliance()(i, 0) * q[0];
        propagator->advance(q);
        if (k < 2)
          continue;
        // impulse at 0, constant until h, linear: a hat from 0 to 2 h around h
        const double shift = interpolation == ForceInterpolation::impulse    ? 0
                             : interpolation == ForceInterpolation::constant ? 0.5 * h
                                                                             : h,
                     mean = (2 * u[0] + 3 * u[1]) / M,
                     exact = push * h / M * (t - shift) - 0.5 * 9.81 * t * t;
        worst_mean = std::max(worst_mean, std::abs(mean - exact));
        if (interpolation == ForceInterpolation::impulse && method.name != "theta method")
        {
          const double omega = body.omega[1], wd = omega * std::sqrt(1 - zeta * zeta),
                       apart = push * h / 2 * std::exp(-zeta * omega * t) * std::sin(wd * t) / wd;
          worst_apart = std::max(worst_apart, std::abs(u[0] - u[1] - apart));
        }
      }
      EXPECT_LT(worst_mean, 1e-13) << method.name;  // of 0.44 m
      EXPECT_LT(worst_apart, 1e-14) << method.name; // of 1e-5 m
    }
}

TEST(BodyInContact, NothingPressesAFreeBodyAndNoRestIsItsOwn)
{
  const BodyInContact poles = by_poles(two_masses(0.03));
  EXPECT_THROW(state_in_equilibrium(poles), InputError);
  EXPECT_THROW(indentation_of_load(poles, {0., 0.}, 10.), InputError);
}

TEST(BodyInContact, RingAtRestByRealModesIsTheRingByPoles)
{
  RingParameters ring;
  ring.n_points = 3;
  ring.tread_stiffness = 3e5;
  ring.tread_tangential_stiffness = 2e5;
  const std::vector<RingRow> rows = ring_rows(ring, true);
  const BodyInContact modes = ring_modes(ring, rows), poles = ring_poles(ring, rows);
  EXPECT_EQ(modes.n_modes(), poles.n_poles());
  for (const double frequency : {0., 30., 155., 700., 2500.})
    EXPECT_LT(difference(receptance(modes, 2 * M_PI * frequency), receptance(poles, 2 * M_PI * frequency)),
              1e-11)
        << frequency;
}

TEST(BodyInContact, TwoTogetherMoveAgainstEachOther)
{
  // a rigid motion by poles is exact in time, but loses digits in the difference of its receptances
  BodyInContact masses = two_masses(0.03);
  masses.omega[0] = 30;
  DenseMatrix trace(2, 1), residual(2, 2);
  trace(0, 0) = 0.7;
  trace(1, 0) = -0.2;
  residual(0, 0) = 2e-6;
  residual(0, 1) = residual(1, 0) = 1e-6;
  residual(1, 1) = 3e-6;
  BodyInContact held{{90.}, {0.1}, trace, {}, residual, {"held"}};
  held.residual_load = {1e-3, 2e-3};
  held.relaxation = 1e-4;
  const double turned_rows[] = {-1., 0.};
  const std::vector<SignedRow> turned = {{0, turned_rows[0]}, {1, turned_rows[1]}};
  for (const BodyInContact &second : {held, by_poles(held)})
  {
    const BodyInContact pair = together(masses, with_rows(second, turned));
    EXPECT_EQ(pair.relaxation, second.relaxation);
    EXPECT_EQ(pair.residual_load[0], -1e-3);
    EXPECT_EQ(pair.residual_load[1], 0);
    EXPECT_EQ(pair.labels.size(), pair.n_modes() + pair.n_poles());
    for (const double w : {5., 80., 220., 900.})
    {
      const ComplexMatrix G = receptance(pair, w), first = receptance(masses, w), other = receptance(held, w);
      for (unsigned int i = 0; i < 2; ++i)
        for (unsigned int j = 0; j < 2; ++j)
        {
          const auto exact = first(i, j) + turned_rows[i] * turned_rows[j] * other(i, j);
          EXPECT_NEAR(std::abs(G(i, j) / exact - 1.), 0, 1e-9) << i << j << " at " << w;
        }
    }
  }
}
