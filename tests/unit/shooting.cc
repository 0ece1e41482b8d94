// Periodic motion against a stop by shooting: amplitudes in closed form, plain small steps, energy, conservation of phase
// volume, differences, limit of the stiff spring.

#include "axial_bar.h"
#include "pi.h"

#include <vibrocontact/analyses/periodic/shooting.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/contact/laws/normal_laws.h>
#include <vibrocontact/propagators/modal_step.h>

#include <gtest/gtest.h>

using namespace vibrocontact;

namespace
{
  /// all modes with spring and penalty, massless contact node with all laws
  struct Problem
  {
    std::string name;
    AxialBarCase c;
    ForcedBody body;
    std::shared_ptr<const NormalLaw> law;
  };

  std::vector<Problem> problems()
  {
    std::vector<Problem> all;
    for (const AxialBarCase &c : {axial_bar_150(), axial_bar_1275()})
    {
      const std::string f = std::to_string(int(c.frequency)) + " Hz, ";
      const ForcedBody body = axial_bar(c), massless = axial_bar(c, true);
      const auto spring = create_normal_law("linear spring", {c.stiffness(), 1}),
                 penalty = create_normal_law("exponential penalty", {c.amplitude, c.exponent});
      all.push_back({f + "spring", c, body, spring});
      all.push_back({f + "penalty", c, body, penalty});
      all.push_back({f + "massless, spring", c, massless, spring});
      all.push_back({f + "massless, penalty", c, massless, penalty});
      all.push_back({f + "massless, rigid", c, massless, create_normal_law("signorini")});
    }
    return all;
  }

  /// largest difference of displacements over the largest displacement
  double distance(const ShootingSolution &a, const ShootingSolution &b, const unsigned int n_samples = 200)
  {
    double largest = 0, difference = 0;
    for (unsigned int k = 0; k < n_samples; ++k)
    {
      const double u = a.at((k + 0.3) / n_samples).displacement;
      largest = std::max(largest, std::abs(u));
      difference = std::max(difference, std::abs(u - b.at((k + 0.3) / n_samples).displacement));
    }
    return difference / largest;
  }

  /// State after a period from x at a phase by the classical Runge-Kutta method in equal steps.
  std::vector<double> runge_kutta(const Problem &p, const double phase, std::vector<double> x,
                                  const unsigned int n_steps)
  {
    const unsigned int n = p.body.n_modes(), m = x.size();
    const double T = 1 / p.c.frequency, h = T / n_steps, S = p.body.residual(0, 0), beta = p.body.relaxation;
    const auto rates = [&](const double t, const std::vector<double> &y, std::vector<double> &d)
    {
      const double s = p.c.force * std::sin(2 * pi * p.c.frequency * t);
      double u = m > 2 * n ? y[2 * n] : 0.;
      for (unsigned int k = 0; k < n; ++k)
        u += p.body.trace(0, k) * y[k];
      const double depth = std::max(0., u - p.body.gap[0]);
      const double f =
          p.law->is_linear() ? p.c.stiffness() * depth : p.c.amplitude * std::expm1(p.c.exponent * depth);
      for (unsigned int k = 0; k < n; ++k)
      {
        const double w = p.body.omega[k];
        d[k] = y[n + k];
        d[n + k] = p.body.modal_force(k) * s - p.body.trace(0, k) * f -
                   w * (w * y[k] + 2 * p.body.damping_ratio[k] * y[n + k]);
      }
      if (m > 2 * n)
        d[2 * n] = (p.body.residual_force(0) * s - S * f - y[2 * n]) / beta;
    };
    std::vector<double> d1(m), d2(m), d3(m), d4(m), y(m);
    for (unsigned int i = 0; i < n_steps; ++i)
    {
      const double t = phase * T + i * h;
      const auto between = [&](const std::vector<double> &d, const double share)
      {
        for (unsigned int k = 0; k < m; ++k)
          y[k] = x[k] + share * h * d[k];
      };
      rates(t, x, d1);
      between(d1, 0.5);
      rates(t + h / 2, y, d2);
      between(d2, 0.5);
      rates(t + h / 2, y, d3);
      between(d3, 1);
      rates(t + h, y, d4);
      for (unsigned int k = 0; k < m; ++k)
        x[k] += h / 6 * (d1[k] + 2 * (d2[k] + d3[k]) + d4[k]);
    }
    return x;
  }

  /// State after `time` in contact under a linear law from x at a phase: exponential of the linear system of modes, residual,
  /// F sin, F cos and 1, by its series on a 2^k-th of the time and k squarings; contact force at the end.
  std::vector<double> exponential(const Problem &p, const double phase, const std::vector<double> &x,
                                  const double time, double &force)
  {
    const unsigned int n = p.body.n_modes(), m = x.size(), sine = m, cosine = m + 1, one = m + 2;
    const double S = p.body.residual(0, 0), beta = p.body.relaxation, Omega = 2 * pi * p.c.frequency;
    const bool residual = m > 2 * n, rigid = p.law->is_rigid();
    // f = row . state
    std::vector<double> row(m + 3, 0.);
    const double k = rigid ? 1 / S : p.c.stiffness();
    for (unsigned int j = 0; j < n; ++j)
    {
      row[j] = k * p.body.trace(0, j);
      row[n + j] = rigid ? k * beta * p.body.trace(0, j) : 0.;
    }
    if (residual && rigid)
      row[sine] = k * p.body.residual_force(0);
    else if (residual)
      row[2 * n] = k;
    row[one] = -k * p.body.gap[0];
    DenseMatrix A(m + 3, m + 3);
    for (unsigned int j = 0; j < n; ++j)
    {
      const double w = p.body.omega[j];
      A(j, n + j) = 1;
      A(n + j, j) = -w * w;
      A(n + j, n + j) = -2 * p.body.damping_ratio[j] * w;
      A(n + j, sine) = p.body.modal_force(j);
      for (unsigned int i = 0; i < m + 3; ++i)
        A(n + j, i) -= p.body.trace(0, j) * row[i];
      if (residual && rigid)
        A(2 * n, n + j) = -p.body.trace(0, j);
    }
    if (residual && !rigid)
    {
      A(2 * n, 2 * n) = -1 / beta;
      A(2 * n, sine) = p.body.residual_force(0) / beta;
      for (unsigned int i = 0; i < m + 3; ++i)
        A(2 * n, i) -= S / beta * row[i];
    }
    A(sine, cosine) = Omega;
    A(cosine, sine) = -Omega;
    // displacements times the highest frequency: entries of one size
    const double top = p.body.omega.back();
    std::vector<double> scale(m + 3, 1.);
    for (unsigned int j = 0; j < n; ++j)
      scale[j] = top;
    if (residual)
      scale[2 * n] = top;
    for (unsigned int i = 0; i < m + 3; ++i)
      for (unsigned int j = 0; j < m + 3; ++j)
        A(i, j) *= scale[i] / scale[j];
    const unsigned int squarings = 30;
    A *= std::ldexp(time, -static_cast<int>(squarings));
    // E = exp - 1, so that nothing is lost beside 1
    DenseMatrix E = A, term = A, product(m + 3, m + 3);
    for (unsigned int i = 2; i < 8; ++i)
    {
      term.mmult(product, A);
      term = product;
      term *= 1. / i;
      E.add(1., term);
    }
    for (unsigned int i = 0; i < squarings; ++i)
    {
      E.mmult(product, E);
      E *= 2;
      E.add(1., product);
    }
    std::vector<double> start = x, end(m + 3);
    start.insert(start.end(),
                 {p.c.force * std::sin(2 * pi * phase), p.c.force * std::cos(2 * pi * phase), 1.});
    for (unsigned int i = 0; i < m + 3; ++i)
    {
      end[i] = start[i];
      for (unsigned int j = 0; j < m + 3; ++j)
        end[i] += E(i, j) / scale[i] * scale[j] * start[j];
    }
    force = 0;
    for (unsigned int i = 0; i < m + 3; ++i)
      force += row[i] * end[i];
    end.resize(m);
    return end;
  }

  double relative(const PeriodMap &map, std::vector<double> a, const std::vector<double> &b)
  {
    for (unsigned int k = 0; k < a.size(); ++k)
      a[k] -= b[k];
    return map.norm(a) / map.norm(b);
  }
} // namespace

TEST(Shooting, FreeModesAndTheirAnswersForAnyDamping)
{
  // a force linear in the step: the exact propagator of the transient analysis knows it
  const GaussRule rule(6);
  for (const double omega : {0., 0.3, 40., 3000.})
    for (const double zeta : {0., 0.3, 1 - 1e-9, 1., 1 + 1e-9, 1.2, 30.})
    {
      ForcedBody body;
      body.omega = {omega};
      body.damping_ratio = {zeta};
      const double h = 0.7, x = 0.6;
      const ForceAnswer answer = answer_to_force(body, rule, h, x, 0);
      const ModalStep step = exact_step(omega, zeta, x * h, ReactionWeighting::as_other_forces);
      EXPECT_NEAR(answer.free[0].qq, step.T[0][0], 1e-12);
      EXPECT_NEAR(answer.free[0].qv * (1 + omega), step.T[0][1] * (1 + omega), 1e-11);
      EXPECT_NEAR(answer.free[0].vv, step.T[1][1], 1e-11);
      // p = 2 + 3 tau
      double q = 0, v = 0;
      for (unsigned int j = 0; j < 6; ++j)
      {
        q += answer.displacement[j] * (2 + 3 * h * rule.node[j]);
        v += answer.velocity[j] * (2 + 3 * h * rule.node[j]);
      }
      const double p1 = 2 + 3 * x * h, scale = 1 + omega * omega;
      EXPECT_NEAR(q * scale, (step.g0[0] * 2 + step.g1[0] * p1) * scale, 1e-10) << omega << " " << zeta;
      EXPECT_NEAR(v * (1 + omega), (step.g0[1] * 2 + step.g1[1] * p1) * (1 + omega), 1e-10)
          << omega << " " << zeta;
    }
}

TEST(Shooting, NoContact)
{
  for (const AxialBarCase &c : {axial_bar_150(), axial_bar_1275()})
  {
    ForcedBody body = axial_bar(c);
    EXPECT_NEAR(body.omega[0] / (2 * pi), 1273.147, 5e-4);
    body.gap[0] = 1;
    const ShootingSolution s = shoot(body, create_normal_law("linear spring", {1e9, 1}), c.excitation());
    EXPECT_TRUE(s.contacts.empty());
    double squares = 0;
    for (unsigned int k = 0; k < 64; ++k)
      squares += std::pow(s.at(k / 64.).displacement, 2) / 32;
    EXPECT_NEAR(std::sqrt(squares) / c.linear_amplitude, 1, 3e-7);
    EXPECT_EQ(s.impulse, 0);
  }
}

TEST(Shooting, PeriodicRefinedAndOfHighOrder)
{
  for (const Problem &p : problems())
  {
    const ShootingSolution s = shoot(p.body, p.law, p.c.excitation());
    EXPECT_LT(s.periodicity, 1e-12) << p.name;
    EXPECT_LT(s.refinement, 1e-11) << p.name;
    ASSERT_EQ(s.contacts.size(), 1u) << p.name;
    // another phase of comparison, other steps, other polynomials
    ShootingSettings other;
    other.n_steps = 3 * s.map->n_steps() + 1;
    other.n_nodes = 6;
    other.phase = 0.05;
    const ShootingSolution b = shoot(p.body, p.law, p.c.excitation(), other);
    EXPECT_LT(distance(s, b), 1e-10) << p.name;
    EXPECT_NEAR(b.impulse / s.impulse, 1, 1e-10) << p.name;
    EXPECT_NEAR(b.contacts[0].begin, s.contacts[0].begin, 1e-11) << p.name;
    EXPECT_NEAR(b.contacts[0].end, s.contacts[0].end, 1e-10) << p.name;
    EXPECT_NEAR(b.energy_norm / s.energy_norm, 1, 1e-10) << p.name;
  }
}

TEST(Shooting, SmallStepsOfRungeKuttaFindTheSameMotion)
{
  for (const Problem &p : problems())
    if (!p.law->is_rigid())
    {
      // a section in contact: what the contact did has not decayed there
      const ShootingSolution s = shoot(p.body, p.law, p.c.excitation());
      const double phase = s.contacts[0].begin + 0.6 * (s.contacts[0].end - s.contacts[0].begin);
      const std::vector<double> x = s.map->advance(s.state, s.phase, phase + 1 - s.phase);
      const unsigned int n_steps = p.c.frequency < 200 ? 80000 : 40000;
      EXPECT_LT(relative(*s.map, runge_kutta(p, phase, x, n_steps), x), 1e-7) << p.name;
    }
}

TEST(Shooting, ContactsOfLinearLawsAreExponentials)
{
  for (const Problem &p : problems())
    if (p.law->is_linear())
    {
      const ShootingSolution s = shoot(p.body, p.law, p.c.excitation());
      ASSERT_EQ(s.contacts.size(), 1u) << p.name;
      const double touch = s.contacts[0].begin, span = s.contacts[0].end - touch;
      const std::vector<double> at_touch = s.map->advance(s.state, s.phase, touch + 1 - s.phase);
      const std::vector<double> at_release = s.map->advance(s.state, s.phase, touch + 1 + span - s.phase);
      double force = 0, half_force = 0;
      EXPECT_LT(relative(*s.map, exponential(p, touch, at_touch, span / p.c.frequency, force), at_release),
                1e-9)
          << p.name;
      exponential(p, touch, at_touch, 0.5 * span / p.c.frequency, half_force);
      EXPECT_NEAR(force / half_force, 0, 1e-7) << p.name;
      EXPECT_NEAR(s.at(touch + 0.5 * span).force / half_force, 1, 1e-8) << p.name;
    }
}

TEST(Shooting, WorkOfTheForceIsWhatDampingTakes)
{
  for (const Problem &p : problems())
  {
    const ShootingSolution s = shoot(p.body, p.law, p.c.excitation());
    const unsigned int n = p.body.n_modes();
    double work = 0, loss = 0, time = 0, momentum = 0;
    s.map->integrate(s.orbit,
                     [&](const double weight, const MotionSample &m)
                     {
                       double residual_rate = m.velocity;
                       for (unsigned int k = 0; k < n; ++k)
                       {
                         loss += weight * 2 * p.body.damping_ratio[k] * p.body.omega[k] * m.v[k] * m.v[k];
                         residual_rate -= p.body.trace(0, k) * m.v[k];
                       }
                       if (p.body.residual(0, 0) > 0)
                         loss += weight * p.body.relaxation * residual_rate * residual_rate /
                                 p.body.residual(0, 0);
                       time += weight;
                       momentum += weight * m.force;
                     });
    for (const OrbitPiece &piece : s.orbit.pieces)
    {
      // the force's phase at Gauss points of a rule of its own, on halves of the pieces
      const GaussRule rule(12);
      for (unsigned int i = 0; i < rule.s && piece.length > 0; ++i)
      {
        const double t = piece.begin + rule.node[i] * piece.length;
        const MotionSample m = s.at(t * p.c.frequency);
        work += rule.weight[i] * piece.length * p.c.force * std::sin(2 * pi * p.c.frequency * t) * m.velocity;
      }
    }
    EXPECT_NEAR(time * p.c.frequency, 1, 1e-13) << p.name;
    EXPECT_NEAR(momentum / s.impulse, 1, 1e-12) << p.name;
    // the Gauss points do not resolve what the fastest overdamped modes do after an event
    EXPECT_NEAR(work / loss, 1, 1e-8) << p.name;
  }
}

TEST(Shooting, MonodromyAgainstDifferences)
{
  for (const Problem &p : problems())
  {
    const ShootingSolution s = shoot(p.body, p.law, p.c.excitation());
    const PeriodMap &map = *s.map;
    // over the touch
    const double phase = s.contacts[0].begin - 0.01, span = 0.02;
    const std::vector<double> x = map.advance(s.state, s.phase, phase + 1 - s.phase);
    DenseMatrix M;
    map.advance(x, phase, span, &M);
    const unsigned int n = p.body.n_modes(), m = map.n_states();
    double worst = 0, largest = 0;
    for (unsigned int j = 0; j < m; ++j)
    {
      // in parts of what each state does to the energy
      const double unit = j < n ? 1 / p.body.omega[j] : j < 2 * n ? 1. : std::sqrt(p.body.residual(0, 0));
      const double change = 1e-6 * map.norm(x) * unit;
      std::vector<double> above = x, below = x;
      above[j] += change;
      below[j] -= change;
      above = map.advance(above, phase, span);
      below = map.advance(below, phase, span);
      std::vector<double> difference(m), derivative(m);
      for (unsigned int i = 0; i < m; ++i)
      {
        derivative[i] = M(i, j) * unit;
        difference[i] = (above[i] - below[i]) / (2 * change) * unit - derivative[i];
      }
      worst = std::max(worst, map.norm(difference));
      largest = std::max(largest, map.norm(derivative));
    }
    EXPECT_LT(worst, 2e-6 * largest) << p.name;
  }
}

TEST(Shooting, MultipliersMultiplyToTheLossOfPhaseVolume)
{
  // three modes, so that the product does not vanish
  const AxialBarCase c = axial_bar_1275();
  ForcedBody body = axial_bar(c);
  body.omega.resize(3);
  body.damping_ratio.resize(3);
  body.modal_load.resize(3);
  DenseMatrix trace(1, 3);
  double exponent = 0;
  for (unsigned int k = 0; k < 3; ++k)
  {
    trace(0, k) = body.trace(0, k);
    exponent += 2 * body.damping_ratio[k] * body.omega[k] / c.frequency;
  }
  body.trace = trace;
  for (const auto &law : {create_normal_law("linear spring", {c.stiffness(), 1}),
                          create_normal_law("exponential penalty", {c.amplitude, c.exponent})})
  {
    const ShootingSolution s = shoot(body, law, c.excitation());
    ASSERT_FALSE(s.contacts.empty());
    std::complex<double> product = 1;
    for (const std::complex<double> mu : floquet_multipliers(s.monodromy))
      product *= mu;
    EXPECT_NEAR(product.real() * std::exp(exponent), 1, 1e-8);
    EXPECT_NEAR(product.imag() * std::exp(exponent), 0, 1e-8);
  }
}

TEST(Shooting, StiffSpringTendsToTheRigidStop)
{
  for (const AxialBarCase &c : {axial_bar_150(), axial_bar_1275()})
  {
    const ForcedBody body = axial_bar(c, true);
    const ShootingSolution rigid = shoot(body, create_normal_law("signorini"), c.excitation());
    double before = 0;
    for (const double k : {1e12, 1e13, 1e14})
    {
      const double error =
          distance(shoot(body, create_normal_law("linear spring", {k, 1}), c.excitation()), rigid);
      if (before > 0)
        EXPECT_NEAR(before / error, 10, 0.5);
      before = error;
    }
    // between touch and release the tip does not move, the force is positive
    const ContactInterval i = rigid.contacts.at(0);
    for (unsigned int k = 1; k < 50; ++k)
    {
      const MotionSample m = rigid.at(i.begin + k / 50. * (i.end - i.begin));
      EXPECT_NEAR(m.displacement, c.gap, 1e-15);
      EXPECT_EQ(m.velocity, 0);
      EXPECT_GT(m.force, 0);
    }
  }
}

TEST(Shooting, PreloadAndPermanentContact)
{
  // a spring that is never left: a linear structure of its own
  const AxialBarCase c = axial_bar_150();
  const double k = c.stiffness();
  ForcedBody body = axial_bar(c);
  body.gap[0] = -2e-3;
  const ShootingSolution s = shoot(body, create_normal_law("linear spring", {k, 1}), c.excitation());
  ASSERT_EQ(s.contacts.size(), 1u);
  EXPECT_EQ(s.contacts[0].end - s.contacts[0].begin, 1);
  // u = H (F s - k (u + 2 mm)): H / (1 + k H) at f and at rest
  const double Omega = 2 * pi * c.frequency;
  std::complex<double> H = 0;
  double H0 = 0;
  for (unsigned int m = 0; m < body.n_modes(); ++m)
  {
    const double w = body.omega[m], b2 = std::pow(body.trace(0, m), 2);
    H += b2 / std::complex<double>(w * w - Omega * Omega, 2 * body.damping_ratio[m] * w * Omega);
    H0 += b2 / (w * w);
  }
  const std::complex<double> U = c.force * H / (1. + k * H);
  for (const double phase : {0.1, 0.35, 0.9})
    EXPECT_NEAR(s.at(phase).displacement * 1e3,
                ((U * std::polar(1., 2 * pi * phase)).imag() - 2e-3 * H0 * k / (1 + k * H0)) * 1e3, 1e-10);
  // the rigid stop with preload opens and closes, with and without damping of the massless node
  ForcedBody massless = axial_bar(c, true);
  massless.gap[0] = -0.3e-3;
  const ShootingSolution damped = shoot(massless, create_normal_law("signorini"), c.excitation());
  EXPECT_FALSE(damped.contacts.empty());
  EXPECT_LT(damped.periodicity, 1e-11);
  massless.relaxation = 0;
  EXPECT_LT(shoot(massless, create_normal_law("signorini"), c.excitation()).periodicity, 1e-11);
}

TEST(Shooting, ResidualLeadsAlongTheBranch)
{
  const AxialBarCase c = axial_bar_1275();
  const ForcedBody body = axial_bar(c);
  const auto law = create_normal_law("exponential penalty", {c.amplitude, c.exponent});
  ShootingSettings settings;
  settings.n_steps = 128;
  settings.phase = 0.9;
  const ShootingSolution s = shoot(body, law, c.excitation(), settings);
  ShootingResidual r = shooting_residual(body, law, c.excitation(), 128, 0.9, s.state);
  EXPECT_LT(s.map->norm(r.value), 1e-9 * s.map->norm(s.state));
  // dx/df = - (P_x - 1)^-1 P_f
  DenseVector slope(s.state.size());
  for (unsigned int k = 0; k < s.state.size(); ++k)
    slope[k] = -r.by_frequency[k];
  r.by_state.compute_lu_factorization();
  r.by_state.solve(slope);
  const double change = 1e-2;
  const auto at = [&](const double f) {
    return shoot(std::make_shared<PeriodMap>(body, law, HarmonicForce{c.force, f}, 128), 0.9, s.state).state;
  };
  const std::vector<double> above = at(c.frequency + change), below = at(c.frequency - change);
  std::vector<double> expected(s.state.size()), found(s.state.size());
  for (unsigned int k = 0; k < s.state.size(); ++k)
  {
    expected[k] = (above[k] - below[k]) / (2 * change);
    found[k] = slope[k];
  }
  EXPECT_LT(relative(*s.map, found, expected), 1e-6);
}

TEST(Shooting, WhatSettlingLeaves)
{
  const AxialBarCase c = axial_bar_1275();
  const ShootingSolution s =
      shoot(axial_bar(c), create_normal_law("linear spring", {c.stiffness(), 1}), c.excitation());
  const SettledMotion settled = settle(s, 1e-7);
  EXPECT_GT(settled.n_periods, 10u);
  EXPECT_LT(settled.change, 1e-7);
  // the slowest multiplier mu leaves 1 / (1 - |mu|) times the last change
  const double mu = std::abs(floquet_multipliers(s.monodromy)[0]);
  EXPECT_LT(settled.error, 3 * settled.change / (1 - mu));
  EXPECT_GT(settled.error, 0.1 * settled.change);
}

// The motion without contact is 80,000 times the answer at rest: what it would hit the stop with has steps without end.
TEST(Shooting, BesideAnUndampedResonanceItEnds)
{
  const AxialBarCase c = axial_bar_150();
  ForcedBody undamped = axial_bar(c);
  undamped.damping_ratio.assign(undamped.damping_ratio.size(), 0.);
  HarmonicForce force = c.excitation();
  force.frequency = undamped.omega[0] / (2 * pi) * (1 - 6e-6);
  try
  {
    const ShootingSolution s = shoot(undamped, create_normal_law("exponential penalty", {1e8, 50}), force);
    EXPECT_LT(s.periodicity, ShootingSettings().tolerance);
  }
  catch (const ConvergenceError &)
  {
  }
}

TEST(Shooting, RefusesWhatItCannot)
{
  const AxialBarCase c = axial_bar_1275();
  EXPECT_THROW(shoot(axial_bar(c), create_normal_law("signorini"), c.excitation()), InputError);
  ForcedBody two = axial_bar(c);
  two.gap = {1, 1};
  two.trace.reinit(2, 25);
  two.residual.reinit(2, 2);
  EXPECT_THROW(shoot(two, create_normal_law("linear spring", {1e9, 1}), c.excitation()), InputError);
  ForcedBody undamped = axial_bar(c);
  undamped.damping_ratio.assign(25, 0.);
  EXPECT_THROW(
      shoot(undamped, create_normal_law("linear spring", {1e9, 1}), {1., undamped.omega[0] / (2 * pi)}),
      InputError);
  EXPECT_NEAR(1 / create_normal_law("exponential penalty", {1e8, 20})->compression(0).compliance, 2e9, 1e-6);
}
