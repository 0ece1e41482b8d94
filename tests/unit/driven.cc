// What drives a transient: hub motion, roughness and tables against closed forms; steps that adapt.

#include "held_bar.h"
#include "pi.h"

#include <vibrocontact/base/atomic_file.h>
#include <vibrocontact/base/csv_table.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/marching/initial_state.h>
#include <vibrocontact/marching/transient_march.h>

#include <vibrocontact/numerics/short_wave_share.h>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

using namespace vibrocontact;

namespace
{
  RollingCase constants(const double speed, const double hub)
  {
    RollingCase c;
    c.creepage = {speed, 0, 0, 0};
    c.normal_force = 0;
    c.hub_displacement = hub;
    return c;
  }

  struct Motion
  {
    std::vector<double> time, force, tip;
    TransientResult result;
  };

  Motion run(const TransientParameters &parameters, const ContactPair &pair, const RollingCase &constant)
  {
    ContactParameters contact;
    contact.friction = 0;
    const ContactSolverParameters solver;
    const DriveFunction drive = drive_function(parameters, constant, pair.interface.contacts.only());
    DynamicState state = initial_state(parameters, contact, solver, pair, drive(0));
    Motion run;
    run.result = transient(parameters, contact, solver, pair, drive, state,
                           [&](const DynamicState &s, const TransientResult &)
                           {
                             double tip = 0;
                             for (unsigned int k = 0; k < pair.n_modes(); ++k)
                               tip += pair.trace(0, k) * s.q[k];
                             run.time.push_back(s.time);
                             run.force.push_back(s.R[0]);
                             run.tip.push_back(tip);
                             return true;
                           });
    EXPECT_TRUE(run.result.converged) << run.result.message;
    return run;
  }

  TransientParameters parameters(const double step, const double end)
  {
    TransientParameters p;
    p.time_step = step;
    p.end_time = end;
    p.initial_state = "undeformed";
    return p;
  }
} // namespace

// One mode under a hub that moves by A (1 - cos W t): q = Gamma A W^2 / (w^2 - W^2) (cos W t - cos w t).
TEST(Driven, OscillatorOnAMovingHub)
{
  const ContactPair pair = held_bar(1, 0.1);
  TransientParameters p = parameters(1e-3, 10);
  p.initial_gap = 0;
  p.hub_displacement = "-1-0.01*(1-cos(2*t))"; // away from the stop: no contact
  const Motion r = run(p, pair, constants(0, 0));
  const double w = pair.omega[0], W = 2, A = -0.01;
  for (unsigned int i = 0; i < r.time.size(); i += 500)
    EXPECT_NEAR(r.tip[i] / 0.01,
                pair.trace(0, 0) * pair.participation(0, 2) * A * W * W / (w * w - W * W) *
                    (std::cos(W * r.time[i]) - std::cos(w * r.time[i])) / 0.01,
                1e-4);
  EXPECT_LT(std::abs(r.result.energy.imbalance()), 1e-12);
  EXPECT_NEAR(r.result.energy.hub, r.result.energy.stored, 1e-12);
}

// The end of a bar whose hub moves by A t^2 / 2 follows one travel time later, then with twice the acceleration:
// displacement against the hub - A t^2 / 2 before t = 1, A (t - 1)^2 - A t^2 / 2 until t = 3.
TEST(Driven, WaveInABarFromItsHub)
{
  const ContactPair pair = held_bar(200, 1e-3);
  TransientParameters p = parameters(1e-3, 2.9);
  p.integrator = "exact propagator";
  p.hub_displacement = "-1-0.005*t^2"; // upwards
  const Motion r = run(p, pair, constants(0, 0));
  for (unsigned int i = 0; i < r.time.size(); i += 200)
  {
    const double t = r.time[i], A = 0.01;
    const double tip = (t < 1 ? 0 : A * (t - 1) * (t - 1)) - A * t * t / 2; // upwards, against the hub
    EXPECT_NEAR(r.tip[i] / A, tip / A, 3e-3) << t;
  }
}

// Pressed by its hub on a stop whose roughness passes with V: N = N0 + h / (W~ + Psi^2 / (w^2 - (k V)^2)) sin k V t in the
// end; a run from equilibrium adds the free vibration of the mode on its contact, which a damped mode forgets.
TEST(Driven, RoughnessUnderAnOscillator)
{
  ContactPair pair = held_bar(1, 0.1);
  pair.damping_ratio[0] = 0.3;
  TransientParameters p = parameters(1e-3, 40);
  p.initial_state = "quasi-static";
  p.roughness.expression = "1e-3*sin(2*pi*s/4)";
  const double V = 2, h = 1e-3, W = 2 * pi / 4 * V, w = pair.omega[0], zeta = pair.damping_ratio[0];
  const Motion r = run(p, pair, constants(V, 0.05));
  // compliance C = W~ + Psi^2 / (w^2 - W^2 + 2 i zeta w W); N = N0 + Im(h e^{i W t} / C)
  const std::complex<double> C =
      0.1 + std::pow(pair.trace(0, 0), 2) / std::complex<double>(w * w - W * W, 2 * zeta * w * W);
  const double N0 = 0.05 / (0.1 + std::pow(pair.trace(0, 0) / w, 2));
  EXPECT_NEAR(r.force.front() / N0, 1, 0.1);
  for (unsigned int i = r.time.size() - 4000; i < r.time.size(); i += 250)
    EXPECT_NEAR((r.force[i] - N0) / h, (std::exp(std::complex<double>(0, W * r.time[i])) / C).imag(), 2e-3);
  const EnergyAccount &energy = r.result.energy;
  EXPECT_LT(std::abs(energy.imbalance()), 1e-3 * energy.damping);
}

TEST(Driven, RoughnessSpectrum)
{
  // one band of 20 dB at 0.1 m: 10 um rms in the mean over a long way
  write_file("driven_spectrum.csv", "# levels\nwavelength_m, level_dB\n0.1, 20\n");
  RoughnessParameters parameters;
  parameters.spectrum = "driven_spectrum.csv";
  ContactGrid grid;
  grid.n_x = 3;
  grid.n_y = 2;
  grid.spacing_x = grid.spacing_y = 1e-3;
  grid.x_first = -1e-3;
  const Roughness roughness(parameters, grid);
  double square = 0;
  const unsigned int n = 200000;
  for (unsigned int i = 0; i < n; ++i)
    square += std::pow(roughness.heights(i * 0.0123)[0], 2) / n;
  EXPECT_NEAR(std::sqrt(square) * 1e6, 10, 0.1);
  // what is at x = -1 mm comes to x = 0 after 1 mm; the same along y
  EXPECT_NEAR(roughness.heights(0.5)[0] * 1e6, roughness.heights(0.501)[1] * 1e6, 1e-6);
  EXPECT_EQ(roughness.heights(0.5)[0], roughness.heights(0.5)[3]);
  // the same seed gives the same heights on every machine, another seed others
  EXPECT_NEAR(roughness.heights(0)[1] * 1e6, 9.124796688, 1e-6);
  parameters.seed = 2;
  EXPECT_GT(std::abs(Roughness(parameters, grid).heights(0)[1] - roughness.heights(0)[1]), 1e-8);
}

// What points of 1 mm cannot carry: waves shorter than 2 mm, alone, beside a long one of ten times their height, and of a step.
TEST(Driven, ShortWaves)
{
  const double spacing = 1e-3;
  const auto share = [&](const std::function<double(double)> &height)
  { return short_wave_share(height, 0, 3, spacing); };
  const auto wave = [](const double length)
  { return [length](const double s) { return 1e-6 * std::sin(2 * pi * s / length); }; };
  for (const double length : {1e-4, 1e-3, 1.5e-3, 1.9e-3})
    EXPECT_NEAR(share(wave(length)), 1, 1e-2) << length;
  for (const double length : {2.5e-3, 5e-3, 0.1, 10.})
    EXPECT_LT(share(wave(length)), 1e-2) << length;
  EXPECT_NEAR(share([&](const double s) { return 0.1 * wave(1.3e-3)(s) + wave(0.02)(s); }),
              std::sqrt(0.01 / 1.01), 5e-3);
  EXPECT_LT(short_wave_share([](const double s) { return s < 0.1 ? 0. : 1e-3; }, 0, 0.2, spacing), 0.1);
  EXPECT_EQ(share([](const double) { return 1e-3; }), 0);
}

TEST(Driven, Tables)
{
  write_file("driven_table.csv",
             "time_s, hub_displacement_m, lateral_creepage\n0, -1, 0\n1, -1.01, 0.002\n2, -1, 0\n");
  const ContactPair pair = held_bar(1, 0.1);
  TransientParameters p = parameters(1e-3, 2);
  p.drive_table = "driven_table.csv";
  const DriveFunction drive = drive_function(p, constants(1, 0), pair.interface.contacts.only());
  EXPECT_NEAR(drive(0.5).approach, -1.005, 1e-12);
  EXPECT_NEAR(drive(1.25).creepage.lateral, 0.0015, 1e-12);
  // a kink gives the impulse of its change of velocity, 0.02 m/s, once
  double impulse = 0;
  for (unsigned int i = 0; i <= 2000; ++i)
    impulse += 1e-3 * drive(i * 1e-3).hub_acceleration;
  EXPECT_NEAR(impulse, 0.02, 1e-9);
  p.end_time = 2.1;
  EXPECT_THROW(drive_function(p, constants(1, 0), pair.interface.contacts.only()), InputError);
  p.end_time = 2;
  p.lateral_creepage = "0.001";
  EXPECT_THROW(drive_function(p, constants(1, 0), pair.interface.contacts.only()), InputError);
  EXPECT_THROW(read_csv("x.csv", "a, b\n1, 2\n3\n"), InputError);
  EXPECT_THROW(read_csv("x.csv", "a, b\n1; 2\n"), InputError);
  EXPECT_THROW(LinearTable("x", {0, 0}, {1, 2}), InputError);
}

namespace
{
  /// The bar of the bouncing-bar example: 10 m, E 900, rho 1, free, thrown at 10 m/s from 5 m.
  ContactPair free_bar(const unsigned int n_modes)
  {
    ContactPair pair = held_bar(n_modes, 0);
    double residual = 10. / (3 * 900);
    for (unsigned int k = 0; k < n_modes; ++k)
    {
      pair.omega[k] = k * pi * 30 / 10;
      pair.trace(0, k) = std::sqrt((k == 0 ? 1 : 2) / 10.);
      pair.participation(k, 2) = k == 0 ? std::sqrt(10.) : 0;
      if (k > 0)
        residual -= std::pow(pair.trace(0, k) / pair.omega[k], 2);
    }
    for (unsigned int i = 0; i < 3; ++i)
      pair.residual(i, i) = residual;
    return pair;
  }
} // namespace

TEST(Driven, AdaptedSteps)
{
  const ContactPair pair = free_bar(21);
  TransientParameters p = parameters(1e-3, 1.5);
  p.initial_gap = 5;
  p.initial_velocity = -10;
  std::printf("%10s %10s %8s %9s %9s %12s %12s\n", "tolerance", "longest", "steps", "rejected", "solves",
              "impulse", "energy");
  const auto show = [&]
  {
    const TransientResult r = run(p, pair, constants(0, 0)).result;
    std::printf("%10.0e %10.1e %8lu %9lu %9lu %+12.2e %+12.2e\n", p.error_tolerance, p.time_step, r.steps,
                r.rejected, r.steps + r.rejected, r.impulse / 200 - 1, r.energy.stored / 500 - 1);
    return r;
  };
  for (const double step : {4e-3, 2e-3, 1e-3, 5e-4, 2.5e-4})
  {
    p.time_step = step;
    show();
  }
  p.time_step = 0.032;
  p.shortest_step = 6.25e-5;
  TransientResult last;
  for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6})
  {
    p.error_tolerance = tolerance;
    last = show();
    EXPECT_NEAR(last.time, 1.5, 1e-12);
  }
  EXPECT_LT(std::abs(last.impulse / 200 - 1), 1e-3);
  EXPECT_LT(std::abs(last.energy.stored / 500 - 1), 5e-4);
}
