// Roots of bodies with mass on their contact points: elimination by hand, modes with and without the inertia of
// the attachment responses, the layer by LAPACK and by SLEPc, and a sliding mass under falling friction in closed
// form and in time.

#include "element_scene.h"
#include "pi.h"
#include "random_structure.h"

#include <vibrocontact/analyses/stability/sparse_roots.h>
#include <vibrocontact/analyses/stability/stability.h>
#include <vibrocontact/coupled_bodies/inertial_contact.h>
#include <vibrocontact/marching/drive.h>
#include <vibrocontact/marching/initial_state.h>
#include <vibrocontact/marching/transient_march.h>
#include <vibrocontact/numerics/eigenvalues.h>
#include <vibrocontact/reduction/attachment_inertia.h>

#include <gtest/gtest.h>

using namespace vibrocontact;

namespace
{
  std::complex<double> lambda(const StabilityRoot &root)
  {
    return {root.growth, 2 * pi * root.frequency};
  }

  /// largest relative difference of the first roots
  double difference(const std::vector<StabilityRoot> &a, const std::vector<StabilityRoot> &b,
                    const unsigned int n)
  {
    double worst = 0;
    for (unsigned int k = 0; k < n; ++k)
      worst = std::max(worst, std::abs(lambda(a.at(k)) - lambda(b.at(k))) / std::abs(lambda(b.at(k))));
    return worst;
  }

  InertialPair whole(const Structure &s)
  {
    InertialPair pair;
    const unsigned int N = s.n_dofs;
    pair.contacts.only().n_x = s.n_points;
    pair.contacts.only().n_y = 1;
    pair.contacts.only().spacing_x = pair.contacts.only().spacing_y = 1e-3;
    pair.stiffness = s.stiffness;
    pair.mass.reinit(N);
    pair.damping.reinit(N);
    pair.trace.reinit(3 * s.n_points, N);
    pair.to_modes.reinit(N);
    for (unsigned int i = 0; i < N; ++i)
    {
      pair.mass(i, i) = 1;
      if (i < pair.trace.m())
        pair.trace(i, i) = 1;
      for (unsigned int j = 0; j < N; ++j)
        pair.to_modes(i, j) = s.modes[i][j];
      pair.labels.push_back(std::to_string(i));
    }
    pair.omega = s.omega;
    return pair;
  }

  ContactPair with_inertia(const Structure &s, const ContactPair &pair)
  {
    const unsigned int rows = 3 * s.n_points;
    ReducedBody body;
    body.omega = pair.omega;
    body.damping_ratio = pair.damping_ratio;
    body.labels = pair.labels;
    body.modal_load = pair.modal_load;
    body.trace = pair.trace;
    body.residual = pair.residual;
    body.residual_load.assign(rows, 0.);
    DenseMatrix mass(rows);
    for (unsigned int k = 0; k < s.n_dofs; ++k)
      for (unsigned int i = 0; i < rows; ++i)
        for (unsigned int j = 0; j < rows; ++j)
          mass(i, j) += s.modes[k][i] * s.modes[k][j] / std::pow(s.omega[k], 4);
    body = with_attachment_inertia(body, mass);
    ContactPair result = pair;
    result.omega = body.omega;
    result.damping_ratio = body.damping_ratio;
    result.labels = body.labels;
    result.trace = body.trace;
    result.residual = body.residual;
    // the static response has not changed
    DenseMatrix statics = pair.residual, again(rows);
    add_modal_compliance(statics, pair.trace, pair.omega, "body");
    add_modal_compliance(again, result.trace, result.omega, "body");
    again.add(-1., statics);
    EXPECT_LT(again.linfty_norm(), 1e-9 * statics.linfty_norm());
    return result;
  }
} // namespace

TEST(InertialContact, EliminationByHandAndModesWithAttachments)
{
  const Structure s = structure(90, 4);
  const unsigned int n = s.n_points, m = s.n_dofs - n;
  const double mu = 0.4;
  const RollingEquilibrium equilibrium = sliding(n, mu, 100, 0.5);
  const LinearisationOptions options;
  const CreepScheme &scheme = creep_schemes().front();
  const std::vector<StabilityRoot> exact = inertial_roots(whole(s), scheme, equilibrium, options);

  // the normal dofs come first and are zero; N = K_n U acts with friction on the y dofs, C_b on the x dofs
  DenseMatrix A(2 * m);
  for (unsigned int i = 0; i < m; ++i)
  {
    A(i, m + i) = 1;
    const unsigned int row = i + n;
    for (unsigned int j = 0; j < m; ++j)
      A(m + i, j) = -s.stiffness(row, j + n) -
                    (row >= 2 * n && row < 3 * n ? mu * s.stiffness(row - 2 * n, j + n) : 0.);
    if (row < 2 * n)
      A(m + i, m + i) = -mu * 100 / 0.5;
  }
  std::vector<StabilityRoot> by_hand;
  for (const std::complex<double> &value : eigenvalues(A).values)
    if (is_listed(value))
      by_hand.push_back(named_root(value, {}, {}, {}));
  sort_roots(by_hand);
  ASSERT_EQ(by_hand.size(), exact.size());
  EXPECT_LT(difference(exact, by_hand, exact.size()), 1e-9);

  double before = 1;
  for (const unsigned int n_modes : {20, 40, 60})
  {
    const ContactPair part = reduce(s, n_modes, 0);
    const double without = difference(
                     stability_roots(part, linearised_contact(part, scheme, equilibrium, options)), exact, 8),
                 with = difference(
                     inertial_roots(inertial_pair(with_inertia(s, part)), scheme, equilibrium, options),
                     exact, 8);
    std::printf(
        "%u of 90 modes: largest relative error of eight roots %.1e, with the attachments' inertia %.1e\n",
        n_modes, without, with);
    EXPECT_LT(with, without / 5);
    EXPECT_LT(with, before);
    before = with;
  }
}

TEST(InertialContact, GivenForceMovesTheHub)
{
  // a hub that follows is a common motion of all gaps: all modes, against the reduced pair with nearly all
  const Structure s = structure(90, 4);
  RollingEquilibrium equilibrium = sliding(s.n_points, 0.4, 100, 0.5);
  equilibrium.force_given = true;
  const ContactPair part = reduce(s, 75, 0);
  const CreepScheme &scheme = creep_schemes().front();
  EXPECT_LT(difference(stability_roots(part, linearised_contact(part, scheme, equilibrium, {})),
                       inertial_roots(whole(s), scheme, equilibrium, {}), 8),
            1e-4);
}

// A layer without Poisson's effect is pressed down uniformly: N = E (length x width) / height per displacement.
TEST(LayerMpi, PressedUniformly)
{
  ElasticMaterial material = soft();
  material.poisson_ratio = 0;
  for (const unsigned int degree : {1, 2})
    for (const double width : {0., 0.04})
    {
      LayerParameters layer;
      layer.divisions_x = 4;
      layer.divisions_z = 3;
      layer.divisions_y = 2;
      layer.degree = degree;
      layer.width = width;
      const auto scene = layer_scene(layer, material, 5);
      const unsigned int n = scene->pair.n_points();
      DenseMatrix normal(n);
      const DenseMatrix compliance = static_compliance(scene->pair);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          normal(i, j) = compliance(i, j);
      DenseVector force(n);
      force = 1e-5;
      normal.compute_lu_factorization();
      normal.solve(force);
      double sum = 0;
      for (const double f : force)
        sum += f;
      EXPECT_NEAR(sum / (2e9 * 0.1 * (width > 0 ? width : 1) / 0.05 * 1e-5), 1, 1e-8) << degree << width;
    }
}

// The same problem with and without elimination of the constraints, dense and sparse, on any number of ranks.
TEST(LayerMpi, SparseRootsEqualDenseOnes)
{
  const auto scene = layer_scene(LayerParameters(), soft(), 40);
  const FiniteElementPair elements = {{scene->system.get(), &scene->modes}, {}};
  const InertialPair dense = finite_element_pair(elements, scene->pair);
  RollingParameters rolling;
  rolling.creepage.speed = 0;
  rolling.creepage.sliding_x = 0.1;
  rolling.hub_displacement = {2e-5};
  ContactParameters contact;
  contact.friction = 0.2;
  const CreepScheme &scheme = find_creep_scheme(contact.creep_scheme);
  std::vector<StabilityRoot> sparse;
  const auto both = [&](const RollingEquilibrium &about)
  {
    sparse = sparse_roots(elements, scene->pair, scheme, about, {}, 12);
    return inertial_roots(dense, scheme, about, {});
  };
  const std::vector<StabilityResult> results = stability(
      {}, rolling, contact, {}, scene->pair, [](const StabilityResult &) {}, both);
  ASSERT_EQ(sparse.size(), 12u);
  EXPECT_LT(difference(sparse, results[0].roots, 12), 1e-6);
  for (unsigned int k = 0; k < sparse.size(); ++k)
    EXPECT_EQ(sparse[k].label, results[0].roots[k].label);
  // an independent calculation with the same elements: 12.54 kHz, 1,620 1/s
  const StabilityRoot &lowest = *results[0].unstable().front();
  EXPECT_NEAR(lowest.frequency, 12540, 125);
  EXPECT_NEAR(lowest.growth, 1620, 16);
}

namespace
{
  /// A mass of 2 kg on a spring slides at 0.2 m/s under 100 N.
  ContactPair sliding_mass(const double omega, const double zeta)
  {
    ContactPair pair;
    pair.interface.contacts.only().n_x = pair.interface.contacts.only().n_y = 1;
    pair.interface.contacts.only().spacing_x = pair.interface.contacts.only().spacing_y = 1e-3;
    pair.interface.contacts.only().whole_surface = true;
    pair.interface.gap = {0};
    pair.omega = {omega};
    pair.damping_ratio = {zeta};
    pair.labels = {"mass:along x"};
    pair.body = {1};
    pair.modal_load = {0};
    pair.trace.reinit(3, 1);
    pair.trace(1, 0) = 1 / std::sqrt(2.);
    pair.participation.reinit(1, 3);
    pair.residual.reinit(3);
    for (unsigned int c = 0; c < 3; ++c)
      pair.residual(c, c) = 1e-9;
    return pair;
  }
} // namespace

// A mass on its spring and on a contact that yields: w^2 = w_0^2 + 1 / (m (W~ + d'(N))), of the penalty d'(N) = 1 / (alpha
// (a + N)); as a reduced body, and with its contact point as a dof of its own (W~ = 0).
TEST(YieldingContact, FrequencyOfAMassOnAPenalty)
{
  const double omega = 2 * pi * 50, mass = 2, force = 100, a = 300, alpha = 2e4;
  ContactPair pair = sliding_mass(omega, 0);
  pair.labels = {"mass:along z"};
  pair.trace(1, 0) = 0;
  pair.trace(0, 0) = 1 / std::sqrt(mass);
  const double residual = 2e-8;
  pair.residual(0, 0) = residual;
  ContactParameters contact;
  contact.friction = 0;
  RollingParameters rolling;
  rolling.creepage.speed = 0;
  rolling.normal_force = {force};
  StabilityParameters parameters;
  const ContactSolverParameters solver;
  for (const auto &[law, compliance] :
       {std::make_pair("signorini", 0.), std::make_pair("linear spring", 1 / (a * alpha)),
        std::make_pair("exponential penalty", 1 / (alpha * (a + force)))})
  {
    contact.normal_law = law;
    contact.law_values.set("Penalty amplitude", a);
    contact.law_values.set("Penalty exponent", alpha);
    const auto frequency = [&](const double flexibility)
    { return std::sqrt(omega * omega + 1 / (mass * (flexibility + compliance))) / (2 * pi); };
    const StabilityResult result =
        stability(parameters, rolling, contact, solver, pair, [](const StabilityResult &) {})[0];
    EXPECT_NEAR(result.roots[0].frequency / frequency(residual), 1, 1e-9) << law;
    if (compliance == 0)
      continue;
    const InertialPair inertial = inertial_pair(pair);
    const StabilityResult with_mass = stability(
        parameters, rolling, contact, solver, pair, [](const StabilityResult &) {},
        [&](const RollingEquilibrium &about) {
          return inertial_roots(inertial, find_creep_scheme(contact.creep_scheme), about,
                                parameters.options());
        })[0];
    EXPECT_NEAR(with_mass.roots[0].frequency / frequency(0), 1, 1e-9) << law;
  }
}

/// Of a root and in time, about the equilibrium of steady sliding; rising friction damps.
class SlidingMass : public testing::TestWithParam<double>
{
};

TEST_P(SlidingMass, GrowthUnderFrictionOfTheSlipSpeed)
{
  const double ratio = GetParam();
  const double omega = 2 * pi * 50, zeta = 0.002, slip = 0.2;
  const ContactPair pair = sliding_mass(omega, zeta);
  ContactParameters contact;
  contact.friction = 0.3;
  contact.law_values.set("Static friction ratio", ratio);
  contact.law_values.set("Stribeck velocity", 0.3);
  RollingParameters rolling;
  rolling.creepage.speed = 0;
  rolling.creepage.sliding_x = slip;
  rolling.normal_force = {100};
  const double tangent = -0.3 * (ratio - 1) / 0.3 * std::exp(-slip / 0.3),
               expected = -tangent * 100 / (2 * 2.) - zeta * omega;
  ContactSolverParameters solver;
  for (const std::string linearisation : {"consistent", "paper"})
  {
    StabilityParameters parameters;
    parameters.linearisation = linearisation;
    const StabilityRoot root =
        stability(parameters, rolling, contact, solver, pair, [](const StabilityResult &) {})[0].nearest();
    EXPECT_NEAR(root.growth / expected, 1, 1e-9) << linearisation;
  }

  // in time, ten periods: energy about the equilibrium grows as exp(2 growth t)
  TransientParameters parameters;
  parameters.time_step = 1e-5;
  parameters.end_time = 0.2;
  parameters.perturbed_mode = pair.labels[0];
  parameters.perturbation_velocity = 1e-3;
  const DriveFunction drive =
      drive_function(parameters, rolling_cases(rolling, contact).front(), pair.interface.contacts.only());
  DynamicState state = initial_state(parameters, contact, solver, pair, drive(0));
  const double rest = state.q[0];
  const double mu = 0.3 * (1 + (ratio - 1) * std::exp(-slip / 0.3));
  EXPECT_NEAR(rest * omega * omega * std::sqrt(2.) / (-mu * 100), 1, 1e-8);
  const auto energy = [&] { return std::pow(state.v[0], 2) + std::pow(omega * (state.q[0] - rest), 2); };
  const double before = energy();
  const TransientResult result =
      transient(parameters, contact, solver, pair, drive, state,
                [](const DynamicState &, const TransientResult &) { return true; });
  EXPECT_TRUE(result.converged);
  const double growth = std::log(energy() / before) / (2 * parameters.end_time);
  std::printf("sliding mass, friction at rest %g times: growth in time %.5f, closed form %.5f 1/s\n", ratio,
              growth, expected);
  EXPECT_NEAR(growth / expected, 1, 2e-3);
}

INSTANTIATE_TEST_SUITE_P(FallingAndRising, SlidingMass, testing::Values(1.5, 0.5));

namespace
{
  /// Share of the steps in stick over the last fifth of a second; the belt goes at 20 mm/s, the mass starts at ten times
  /// that.
  double sticking(const double ratio, const double velocity)
  {
    const ContactPair pair = sliding_mass(2 * pi * 50, 0.002);
    ContactParameters contact;
    contact.friction = 0.3;
    contact.law_values.set("Static friction ratio", ratio);
    contact.law_values.set("Stribeck velocity", velocity);
    RollingParameters rolling;
    rolling.creepage.speed = 0;
    rolling.creepage.sliding_x = 0.02;
    rolling.normal_force = {100};
    TransientParameters parameters;
    parameters.time_step = 2e-5;
    parameters.end_time = 1;
    parameters.perturbed_mode = pair.labels[0];
    parameters.perturbation_velocity = 0.2;
    const DriveFunction drive =
        drive_function(parameters, rolling_cases(rolling, contact).front(), pair.interface.contacts.only());
    const ContactSolverParameters solver;
    DynamicState state = initial_state(parameters, contact, solver, pair, drive(0));
    unsigned int stick = 0, n = 0;
    const TransientResult result = transient(parameters, contact, solver, pair, drive, state,
                                             [&](const DynamicState &now, const TransientResult &)
                                             {
                                               if (now.time > 0.8)
                                               {
                                                 ++n;
                                                 stick += now.contact.status[0] == ContactStatus::stick;
                                               }
                                               return true;
                                             });
    EXPECT_TRUE(result.converged);
    return double(stick) / n;
  }
} // namespace

// Falling friction sticks and slips on a slow belt, rising friction comes to steady sliding, however steep it is: over
// 1 mm/s, N dmu/ds h / m is 0.15, and N dmu/ds times the point's flexibility is the 1e-9 of the pair.
TEST(FallingFriction, RisingFrictionEndsStickSlip)
{
  EXPECT_GT(sticking(1.5, 0.02), 0.2);
  EXPECT_EQ(sticking(0.5, 0.02), 0);
  EXPECT_EQ(sticking(0.5, 1e-3), 0);
}
