// Rests that relax, beta r' + r = W R: against all modes of bodies with C = beta K, against the equations of the contact at
// complex frequencies, stability against its own transient, and the account of energy.

#include "held_bar.h"
#include "matrix_difference.h"
#include "one_oscillation.h"
#include "sliding_structure.h"

#include <vibrocontact/analyses/stability/root_count.h>
#include <vibrocontact/coupled_bodies/inertial_contact.h>
#include <vibrocontact/coupled_bodies/sliding_frame.h>
#include <vibrocontact/coupled_bodies/stability_roots.h>
#include <vibrocontact/marching/initial_state.h>
#include <vibrocontact/marching/transient_march.h>
#include <vibrocontact/numerics/complex_singular_values.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;

namespace
{
  using Complex = std::complex<double>;

  void damp(ContactPair &pair, const double beta)
  {
    for (unsigned int k = 0; k < pair.n_modes(); ++k)
      pair.damping_ratio[k] = beta * pair.omega[k] / 2;
  }

  /// A share of the residual relaxes.
  ContactPair relaxing(ContactPair pair, const double beta, const double share = 1)
  {
    pair.relaxing = {{1, beta, pair.residual}};
    pair.relaxing[0].flexibility *= share;
    return pair;
  }

  /// Smallest over largest singular value of the contact's equations at lambda, rows (gap, slip across), unknowns forces N and
  /// across: zero at a root. No states, no elimination.
  double singularity(const ContactPair &pair, const CreepScheme &scheme, const RollingEquilibrium &about,
                     const Complex &lambda)
  {
    const unsigned int n = pair.n_points();
    const SlidingFrame frame = sliding_frame(about);
    const unsigned int c = frame.points.size(), n_z = frame.across.size(),
                       size = c + n_z + (about.force_given ? 1 : 0);
    DenseMatrix E(3 * n, c + n_z);
    for (unsigned int i = 0; i < 3 * n; ++i)
      for (unsigned int k = 0; k < c; ++k)
        E(i, k) = frame.normal(i, k);
    const DenseMatrix across = forces_along(frame.across, n);
    for (unsigned int i = 0; i < 3 * n; ++i)
      for (unsigned int k = 0; k < n_z; ++k)
        E(i, c + k) = across(i, k);
    // compliance at lambda, real and imaginary parts
    DenseMatrix H[2] = {compliance_of_contact(pair, about), DenseMatrix(3 * n, 3 * n)};
    for (const RelaxingRest &rest : pair.relaxing)
    {
      const Complex less = 1. / (1. + rest.relaxation * lambda) - 1.;
      H[0].add(less.real(), rest.flexibility);
      H[1].add(less.imag(), rest.flexibility);
    }
    for (unsigned int k = 0; k < pair.n_modes(); ++k)
    {
      const double w = pair.omega[k];
      const Complex d = 1. / (lambda * lambda + 2 * pair.damping_ratio[k] * w * lambda + w * w);
      for (unsigned int j = 0; j < 3 * n; ++j)
        for (unsigned int i = 0; i < 3 * n; ++i)
        {
          H[0](i, j) += d.real() * pair.trace(i, k) * pair.trace(j, k);
          H[1](i, j) += d.imag() * pair.trace(i, k) * pair.trace(j, k);
        }
    }
    dealii::LAPACKFullMatrix<Complex> F(size, size);
    for (unsigned int part = 0; part < 2; ++part)
    {
      const Complex unit = part == 0 ? Complex(1, 0) : Complex(0, 1);
      DenseMatrix moved(3 * n, c + n_z);
      H[part].mmult(moved, E);
      DenseMatrix convected = moved;
      convert_to_slip_rows(pair.interface.contacts, scheme, about.speed, convected);
      const DenseMatrix along = rows_along(moved, frame.across, n),
                        flow = rows_along(convected, frame.across, n);
      for (unsigned int j = 0; j < c + n_z; ++j)
      {
        for (unsigned int k = 0; k < c; ++k)
          F(k, j) += unit * moved(frame.points[k], j);
        for (unsigned int k = 0; k < n_z; ++k)
          F(c + k, j) += unit * (flow(k, j) + lambda * along(k, j));
      }
    }
    for (unsigned int k = 0; k < n_z; ++k)
      F(c + k, c + k) += frame.mobility[k];
    for (unsigned int k = 0; k < c && about.force_given; ++k)
      F(k, size - 1) = F(size - 1, k) = 1;
    // equations and unknowns have their own units
    for (const bool by_rows : {true, false})
      for (unsigned int i = 0; i < size; ++i)
      {
        const auto entry = [&](const unsigned int j) -> Complex & { return by_rows ? F(i, j) : F(j, i); };
        double largest = 0;
        for (unsigned int j = 0; j < size; ++j)
          largest = std::max(largest, std::abs(entry(j)));
        for (unsigned int j = 0; j < size; ++j)
          entry(j) /= largest;
      }
    const std::vector<double> values = complex_singular_values(F).values;
    return values.back() / values.front();
  }

  StabilityRoot most_unstable(const std::vector<StabilityRoot> &roots)
  {
    return *std::max_element(roots.begin(), roots.end(),
                             [](const auto &a, const auto &b) { return a.growth < b.growth; });
  }

  Complex lambda_of(const StabilityRoot &root)
  {
    return {root.growth, 2 * M_PI * root.frequency};
  }
} // namespace

TEST(RelaxingRest, ByPolesHasTheSameReceptance)
{
  DenseMatrix trace(2, 1), residual(2, 2);
  trace(0, 0) = 0.7;
  trace(1, 0) = -0.2;
  residual(0, 0) = 2e-6;
  residual(0, 1) = residual(1, 0) = 1e-6;
  residual(1, 1) = 3e-6;
  BodyInContact body{{90.}, {0.1}, trace, {}, residual, {"held"}};
  body.relaxation = 1e-3;
  BodyInContact slower = body;
  slower.omega[0] = 70;
  slower.relaxation = 4e-3;
  const BodyInContact poles = rest_by_poles(body), pair = together(body, slower);
  EXPECT_EQ(poles.n_modes(), 1u);
  EXPECT_EQ(poles.n_poles(), 2u);
  EXPECT_FALSE(has_rest(poles));
  for (const double w : {0., 50., 700., 2e4})
  {
    EXPECT_LT(difference(receptance(body, w), receptance(poles, w)), 1e-13) << w;
    ComplexMatrix sum = receptance(body, w);
    sum.add(1., receptance(slower, w));
    EXPECT_LT(difference(sum, receptance(pair, w)), 1e-11) << w;
  }
  EXPECT_EQ(rest_by_poles(poles).n_poles(), 2u);
}

// Growth of the eight lowest roots by few modes and a rest that relaxes, against all modes of the structure with C = beta K. What
// the mass of the dropped modes does is the same by either rest.
TEST(RelaxingRest, StabilityTendsToAllModes)
{
  const Structure s = structure(90, 4);
  const CreepScheme &scheme = creep_schemes().front();
  RollingEquilibrium about = sliding(s.n_points, 0.6, 100, 0.5);
  about.speed = 0.2;
  for (const double beta : {1e-4, 3e-4})
  {
    ContactPair all = reduce(s, 90, 0);
    damp(all, beta);
    const std::vector<StabilityRoot> exact = inertial_roots(inertial_pair(all), scheme, about, {});
    for (const unsigned int n_modes : {30u, 45u, 60u})
    {
      ContactPair few = reduce(s, n_modes, 0);
      damp(few, beta);
      const auto error = [&](const ContactPair &pair)
      {
        const std::vector<StabilityRoot> roots =
            stability_roots(pair, linearised_contact(pair, scheme, about, {}));
        double sum = 0, size = 0;
        for (unsigned int k = 0; k < 8; ++k)
        {
          const StabilityRoot &own = *std::min_element(roots.begin(), roots.end(),
                                                       [&](const StabilityRoot &a, const StabilityRoot &b) {
                                                         return std::abs(lambda_of(a) - lambda_of(exact[k])) <
                                                                std::abs(lambda_of(b) - lambda_of(exact[k]));
                                                       });
          sum += std::pow(own.growth - exact[k].growth, 2);
          size += std::pow(exact[k].growth, 2);
        }
        return std::sqrt(sum / size);
      };
      const double with = error(relaxing(few, beta)), without = error(few);
      std::printf(
          "beta %.0e s, %u of 90 modes: growth off by %.2e with a rest that relaxes, %.2e with an elastic "
          "one; fastest %.4g 1/s\n",
          beta, n_modes, with, without, most_unstable(exact).growth);
      EXPECT_LT(with, n_modes < 60 ? without : without / 4);
    }
  }
}

// Every root solves the contact's own equations; the argument principle counts as many unstable ones. Without relaxation, in
// part and whole; with a spring law, sticking points, a given force.
TEST(RelaxingRest, RootsSolveTheEquationsOfTheContact)
{
  const Structure s = structure(90, 4);
  const CreepScheme &scheme = creep_schemes().front();
  constexpr double beta = 2e-3;
  ContactPair few = reduce(s, 30, 1e-3);
  for (const double share : {0., 0.4, 1.})
    for (const std::string kind : {"held", "force given", "spring", "stick"})
    {
      const ContactPair pair = share > 0 ? relaxing(few, beta, share) : few;
      RollingEquilibrium about = sliding(s.n_points, 0.6, 100, 0.5);
      about.speed = 0.2;
      about.force_given = kind == "force given";
      if (kind == "spring")
        about.normal_compliance.assign(s.n_points, 1e-5);
      LinearisationOptions options;
      options.stick = kind == "stick";
      if (options.stick)
        about.contact.status[1] = about.contact.status[2] = ContactStatus::stick;
      const std::vector<StabilityRoot> roots =
          stability_roots(pair, linearised_contact(pair, scheme, about, options));
      ASSERT_GE(roots.size(), 20u);
      double worst = 0;
      int unstable = 0;
      for (const StabilityRoot &root : roots)
      {
        const double there = singularity(pair, scheme, about, lambda_of(root)),
                     beside = singularity(pair, scheme, about, lambda_of(root) * 1.001);
        // as far as numbers go
        worst = std::max(worst, (there - 1e-15) / beside);
        unstable += root.growth > 0 ? (root.frequency > 0 ? 2 : 1) : 0;
      }
      const RootCount count = count_unstable_roots(pair, scheme, about, roots);
      std::printf("share %.1f, %-11s: %zu roots, %d unstable, singular there to %.1e of beside\n", share,
                  kind.c_str(), roots.size(), unstable, worst);
      EXPECT_LT(worst, 1e-6) << share << kind;
      EXPECT_EQ(count.unstable, unstable) << share << kind;
      EXPECT_LT(std::abs(count.remainder), 2e-2) << share << kind;
    }
}

TEST(RelaxingRest, FastOnesAreElastic)
{
  const Structure s = structure(90, 4);
  const CreepScheme &scheme = creep_schemes().front();
  RollingEquilibrium about = sliding(s.n_points, 0.6, 100, 0.5);
  about.speed = 0.2;
  // some points' friction falls with the speed of modes and transport
  for (const bool falls : {false, true})
  {
    if (falls)
      about.friction_slope.assign(s.n_points, -0.5);
    const ContactPair few = reduce(s, 30, 1e-3);
    const Complex elastic =
        lambda_of(most_unstable(stability_roots(few, linearised_contact(few, scheme, about, {}))));
    std::vector<double> errors;
    for (const double beta : {1e-7, 1e-8})
    {
      const ContactPair pair = relaxing(few, beta);
      errors.push_back(std::abs(lambda_of(most_unstable(
                                    stability_roots(pair, linearised_contact(pair, scheme, about, {})))) -
                                elastic) /
                       std::abs(elastic));
    }
    std::printf(
        "friction that falls %d: growth %.6g 1/s, relaxing in 1e-7 s off by %.2e, in 1e-8 s by %.2e\n", falls,
        elastic.real(), errors[0], errors[1]);
    EXPECT_NEAR(errors[0] / errors[1], 10, 0.5);
    EXPECT_LT(errors[1], 1e-4);
  }
}

class RelaxingGrowth : public testing::TestWithParam<std::tuple<double, std::string>>
{
};

// The growth that the linearisation gives is the transient's.
TEST_P(RelaxingGrowth, IsThatOfTheTransient)
{
  const auto [share, hub] = GetParam();
  const bool force_given = hub == "massless";
  const SlidingStructure sliding(force_given);
  // slow enough for the root near 2900 Hz to stay the fastest
  const double beta = force_given && share == 1 ? 1.5e-6 : 5e-6;
  const ContactPair &few = sliding.pair, pair = relaxing(few, beta, share);
  const ContactParameters &contact = sliding.contact;
  const DriveFunction &drive = sliding.drive;
  ContactSolverParameters solver;
  solver.tolerance = force_given ? 1e-9 : 1e-11;
  TransientParameters parameters;
  const DynamicState rest = initial_state(parameters, contact, solver, pair, drive(0));
  RollingEquilibrium about;
  about.contact = rest.contact;
  about.friction.assign(sliding.whole.n_points, contact.friction);
  about.speed = SlidingStructure::speed;
  about.force_given = force_given;
  const CreepScheme &scheme = find_creep_scheme(contact.creep_scheme);
  const StabilityRoot root =
                          most_unstable(stability_roots(pair, linearised_contact(pair, scheme, about, {}))),
                      elastic =
                          most_unstable(stability_roots(few, linearised_contact(few, scheme, about, {})));
  ASSERT_GT(root.growth, 0);
  const unsigned int k = std::find(pair.labels.begin(), pair.labels.end(), root.label) - pair.labels.begin();
  parameters.end_time = 5 / root.growth;
  const auto growth = [&](const double step)
  {
    parameters.time_step = step;
    const unsigned int every = std::lround(0.15 / root.frequency / step);
    DynamicState state = rest;
    const double amplitude = 5e-6 * std::abs(rest.q[k]) / std::abs(root.shape[k]);
    for (unsigned int i = 0; i < pair.n_modes(); ++i)
    {
      state.q[i] += amplitude * root.shape[i].real();
      state.v[i] += amplitude * (lambda_of(root) * root.shape[i]).real();
    }
    std::vector<double> samples;
    unsigned int count = 0;
    const TransientResult result =
        transient(parameters, contact, solver, pair, drive, state,
                  [&](const DynamicState &now, const TransientResult &)
                  {
                    if (now.time > 0.4 * parameters.end_time && ++count % every == 0)
                      samples.push_back(now.v[k]);
                    return true;
                  });
    EXPECT_TRUE(result.converged) << result.message << result.time;
    return samples.size() > 10 ? fit_one_oscillation(samples, every * step) : Complex();
  };
  // the backward rate of what relaxes is of first order
  const Complex coarse = growth(2e-6), fine = growth(1e-6), lambda = 2. * fine - coarse;
  std::printf(
      "growth %.6g, %.6g, extrapolated %.6g 1/s, %.6g Hz; linearised %.6g, %.6g; elastic rest %.6g, %.6g\n",
      coarse.real(), fine.real(), lambda.real(), lambda.imag() / 2 / M_PI, root.growth, root.frequency,
      elastic.growth, elastic.frequency);
  EXPECT_NEAR(lambda.real() / root.growth, 1, 1e-2);
  EXPECT_NEAR(lambda.imag() / (2 * M_PI * root.frequency), 1, 1e-3);
  EXPECT_GT(std::abs(root.growth / elastic.growth - 1), 0.05);
}

INSTANTIATE_TEST_SUITE_P(RelaxingRest, RelaxingGrowth,
                         testing::Combine(testing::Values(0.5, 1.), testing::Values("held", "massless")),
                         [](const auto &info) {
                           return (std::get<0>(info.param) < 1 ? "half_" : "whole_") +
                                  std::get<1>(info.param);
                         });

namespace
{
  constexpr double bar_beta = 5e-3;

  ContactPair bar(const unsigned int n_modes, const bool relaxes)
  {
    // the static flexibility of the whole is 1
    double residual = 1;
    for (unsigned int k = 0; k < n_modes; ++k)
      residual -= 2 / std::pow((k + 0.5) * M_PI, 2);
    ContactPair pair = held_bar(n_modes, residual);
    damp(pair, bar_beta);
    return relaxes ? relaxing(pair, bar_beta) : pair;
  }

  struct PressedBar
  {
    std::vector<double> force;
    EnergyAccount energy;
  };

  /// The bar pressed down by an approach that swings, now and then open: forces at 800 instants.
  PressedBar pressed(const ContactPair &pair, const unsigned int steps_between, const std::string &integrator)
  {
    constexpr unsigned int n_shown = 800;
    TransientParameters parameters;
    parameters.end_time = 16;
    parameters.time_step = parameters.end_time / (n_shown * steps_between);
    parameters.initial_state = "undeformed";
    parameters.integrator = integrator;
    ContactParameters contact;
    contact.friction = 0;
    const auto approach = [](const double t)
    { return 0.3 * std::pow(std::sin(0.6 * t), 3) - 0.05 * (1 - std::cos(9 * t)) * t / (1 + t); };
    const DriveFunction drive = [&](const double t)
    {
      Drive now;
      now.approach = approach(t);
      const double h = 1e-4;
      now.hub_acceleration = (approach(t + h) - 2 * approach(t) + approach(t - h)) / (h * h);
      return now;
    };
    DynamicState state = initial_state(parameters, contact, {}, pair, drive(0));
    PressedBar result;
    unsigned int count = 0;
    const TransientResult run = transient(parameters, contact, {}, pair, drive, state,
                                          [&](const DynamicState &now, const TransientResult &)
                                          {
                                            if (++count % steps_between == 0)
                                              result.force.push_back(now.R[0]);
                                            return true;
                                          });
    EXPECT_TRUE(run.converged) << run.message;
    result.energy = run.energy;
    return result;
  }

  double error(const std::vector<double> &force, const std::vector<double> &truth)
  {
    double difference = 0, size = 0;
    for (unsigned int k = 0; k < truth.size(); ++k)
    {
      difference += std::pow(force[k] - truth[k], 2);
      size += std::pow(truth[k], 2);
    }
    return std::sqrt(difference / size);
  }
} // namespace

TEST(RelaxingRest, PressedBarTendsToAllModes)
{
  const std::vector<double> truth = pressed(bar(300, true), 16, "exact propagator").force;
  for (const unsigned int n_modes : {3u, 6u, 12u})
  {
    const double with = error(pressed(bar(n_modes, true), 16, "exact propagator").force, truth),
                 without = error(pressed(bar(n_modes, false), 16, "exact propagator").force, truth);
    std::printf("%2u modes: force off by %.2e with a rest that relaxes, %.2e with an elastic one\n", n_modes,
                with, without);
    EXPECT_LT(with, without);
  }
}

TEST(RelaxingRest, StepsConvergeAndEnergyIsAccountedFor)
{
  const ContactPair pair = bar(6, true);
  for (const std::string integrator : {"theta method", "exact propagator"})
  {
    const std::vector<double> truth = pressed(pair, 256, integrator).force;
    std::vector<double> errors, open;
    for (const unsigned int steps : {4u, 16u, 64u})
    {
      const PressedBar run = pressed(pair, steps, integrator);
      const EnergyAccount &e = run.energy;
      errors.push_back(error(run.force, truth));
      open.push_back(std::abs(e.imbalance()) / e.available);
      std::printf(
          "%s, %3u steps: force %.2e, damping %.4e J, differences %.2e J, imbalance %.1e J of %.3e J\n",
          integrator.c_str(), steps, errors.back(), e.damping, e.numerical(), e.imbalance(), e.available);
      EXPECT_GT(e.damping, 0);
    }
    EXPECT_LT(errors[1], errors[0] / 2.5);
    EXPECT_LT(errors[2], errors[1] / 2.5);
    EXPECT_LT(open.back(), 1e-3);
  }
}

// A step that is long against beta neither rings nor is anything but the elastic rest's.
TEST(RelaxingRest, LongStepsAreElastic)
{
  ContactPair elastic = bar(6, false), fast = elastic;
  fast.relaxing = {{1, 1e-7, fast.residual}};
  for (const std::string integrator : {"theta method", "exact propagator"})
    EXPECT_LT(error(pressed(fast, 4, integrator).force, pressed(elastic, 4, integrator).force), 2e-4);
}
