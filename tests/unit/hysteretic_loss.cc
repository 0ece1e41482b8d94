// Hysteretic loss in stability: closed forms, the equations of the contact at complex frequencies (no states), the count of
// roots around a quadrant, and the loss of a rail on lossy pads against its elements.

#include "held_bar.h"
#include "matrix_difference.h"
#include "random_structure.h"

#include <vibrocontact/analyses/stability/root_count.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/coupled_bodies/contact_root.h>
#include <vibrocontact/coupled_bodies/suspended_pair.h>
#include <vibrocontact/fe/beam_elements.h>
#include <vibrocontact/numerics/complex_eigenvectors.h>
#include <vibrocontact/numerics/complex_singular_values.h>
#include <vibrocontact/reduction/compute_modes.h>
#include <vibrocontact/reduction/harmonic_solver.h>
#include <vibrocontact/reduction/reduction_parts.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;

namespace
{
  using Complex = std::complex<double>;
  const Complex j(0, 1);

  const CreepScheme &upwind()
  {
    return find_creep_scheme("first-order upwind");
  }

  Complex value_of(const StabilityRoot &root)
  {
    return {root.growth, 2 * M_PI * root.frequency};
  }

  /// The loss of modes with loss factors of their own and of W~ with one.
  HystereticLoss diagonal_loss(const ContactPair &pair, const double of_modes, const double of_rest)
  {
    HystereticLoss loss;
    loss.modal.reinit(pair.n_modes(), pair.n_modes());
    for (unsigned int k = 0; k < pair.n_modes(); ++k)
      loss.modal(k, k) = of_modes * pair.omega[k] * pair.omega[k];
    loss.residual = ComplexMatrix(pair.residual.m(), pair.residual.n());
    loss.residual.add(1. / (1. + j * of_rest), entries_as<Complex>(pair.residual));
    return loss;
  }

  /// H = a a^T of random couplings on top: positive definite, far from diagonal.
  HystereticLoss coupled_loss(const ContactPair &pair, const double size)
  {
    HystereticLoss loss = diagonal_loss(pair, size / 10, size / 5);
    const unsigned int m = pair.n_modes();
    std::mt19937 random(11);
    std::normal_distribution<double> number;
    DenseMatrix factor(m, 3), product(m, m);
    for (unsigned int c = 0; c < 3; ++c)
      for (unsigned int k = 0; k < m; ++k)
        factor(k, c) = std::sqrt(size) * pair.omega[k] * number(random);
    factor.mTmult(product, factor);
    loss.modal.add(1., product);
    return loss;
  }

  ContactPair undamped(ContactPair pair)
  {
    pair.damping_ratio.assign(pair.n_modes(), 0.);
    return pair;
  }

  std::vector<Complex> unstable(const std::vector<StabilityRoot> &roots)
  {
    std::vector<Complex> result;
    for (const StabilityRoot &root : roots)
      if (root.growth > 0 && root.frequency > 0)
        result.push_back(value_of(root));
    return result;
  }
} // namespace

TEST(HystereticLoss, OneModeOnItsContactHasTheRootOfItsComplexStiffness)
{
  const ContactPair pair = held_bar(1, 0.3);
  const HystereticLoss loss = diagonal_loss(pair, 0.2, 0.5);
  RollingEquilibrium about = sliding(1, 0., 1, 1);
  const std::vector<StabilityRoot> roots = hysteretic_roots(pair, loss, upwind(), about, {});
  ASSERT_EQ(roots.size(), 1u);
  // s^2 + w^2 (1 + 0.2 j) + psi^2 (1 + 0.5 j) / W = 0
  const double w = pair.omega[0];
  const Complex s = j * std::sqrt(w * w * (1. + 0.2 * j) + 2. * (1. + 0.5 * j) / 0.3);
  EXPECT_LT(std::abs(value_of(roots[0]) - s), 1e-12 * std::abs(s));
  EXPECT_LT(s.real(), 0);
  // the mirror image in the lower half plane grows and is none
  const ComplexEigenvectors all =
      complex_eigenvectors(linearised_contact(pair, loss, upwind(), about, {}), "roots");
  ASSERT_EQ(all.values.size(), 2u);
  EXPECT_LT(std::min(std::abs(all.values[0] + s), std::abs(all.values[1] + s)), 1e-12 * std::abs(s));
  EXPECT_EQ(count_unstable_roots(pair, upwind(), about, roots, &loss).unstable, 0);
}

TEST(HystereticLoss, TwoModesThatFrictionCouplesHaveTheRootsOfTheirQuadratic)
{
  // a point that slides along y: K_ab = (psi_n - mu psi_y)_a psi_n_b / W, H in full
  ContactPair pair = held_bar(2, 0.);
  pair.omega = {3., 3.1};
  const double normal[] = {1., 0.8}, along[] = {-1.2, 3.}, W = 4., mu = 0.5, eta = 0.03;
  for (unsigned int k = 0; k < 2; ++k)
  {
    pair.trace(0, k) = normal[k];
    pair.trace(2, k) = along[k];
  }
  for (unsigned int i = 0; i < 3; ++i)
    pair.residual(i, i) = i == 2 ? 0. : W;
  HystereticLoss loss = diagonal_loss(pair, 0., eta);
  const double H[2][2] = {{0.05, 0.04}, {0.04, 0.06}};
  for (unsigned int a = 0; a < 2; ++a)
    for (unsigned int b = 0; b < 2; ++b)
      loss.modal(a, b) = H[a][b];
  const RollingEquilibrium about = sliding(1, mu, 10, 1);
  Complex K[2][2];
  for (unsigned int a = 0; a < 2; ++a)
    for (unsigned int b = 0; b < 2; ++b)
      K[a][b] = (a == b ? pair.omega[a] * pair.omega[a] : 0.) + j * H[a][b] +
                (normal[a] - mu * along[a]) * normal[b] * (1. + j * eta) / W;
  const Complex half = (K[0][0] + K[1][1]) / 2.,
                root = std::sqrt(half * half - K[0][0] * K[1][1] + K[0][1] * K[1][0]);
  std::vector<Complex> expected = {j * std::sqrt(half - root), j * std::sqrt(half + root)};
  std::sort(expected.begin(), expected.end(),
            [](const Complex &a, const Complex &b) { return a.real() > b.real(); });
  const std::vector<StabilityRoot> roots = hysteretic_roots(pair, loss, upwind(), about, {});
  ASSERT_EQ(roots.size(), 2u);
  for (const Complex &s : expected)
    EXPECT_LT(std::min(std::abs(value_of(roots[0]) - s), std::abs(value_of(roots[1]) - s)),
              1e-11 * std::abs(s));
  // one grows, and what grows in the lower half plane is not counted
  EXPECT_GT(expected[0].real(), 0.01);
  EXPECT_EQ(unstable(roots).size(), 1u);
  const RootCount count = count_unstable_roots(pair, upwind(), about, roots, &loss);
  EXPECT_EQ(count.unstable, 1);
  EXPECT_LT(std::abs(count.remainder), 1e-2);
  unsigned int n_growing = 0;
  for (const Complex &s :
       complex_eigenvectors(linearised_contact(pair, loss, upwind(), about, {}), "roots").values)
    n_growing += s.real() > 0;
  EXPECT_EQ(n_growing, 2u);
}

TEST(HystereticLoss, OneLossFactorTurnsAllRootsOfABodyThatNothingElseDamps)
{
  const Structure s = structure(90, 4);
  const ContactPair pair = undamped(reduce(s, 30, 0));
  const double eta = 0.1;
  const RollingEquilibrium about = sliding(s.n_points, 0., 100, 0.5);
  const std::vector<StabilityRoot> elastic =
                                       stability_roots(pair, linearised_contact(pair, upwind(), about, {})),
                                   lossy = hysteretic_roots(pair, diagonal_loss(pair, eta, eta), upwind(),
                                                            about, {});
  ASSERT_EQ(elastic.size(), lossy.size());
  ASSERT_EQ(elastic.size(), 30u);
  for (unsigned int k = 0; k < elastic.size(); ++k)
  {
    const Complex expected = value_of(elastic[k]).imag() * j * std::sqrt(1. + j * eta);
    EXPECT_LT(std::abs(value_of(lossy[k]) - expected), 1e-9 * std::abs(expected));
  }
}

TEST(HystereticLoss, WithoutLossTheRootsAreTheViscousOnes)
{
  const Structure s = structure(90, 4);
  const ContactPair pair = reduce(s, 30, 1e-3);
  for (const bool force_given : {false, true})
  {
    RollingEquilibrium about = sliding(s.n_points, 0.4, 100, 0.5);
    about.force_given = force_given;
    about.speed = 0.02;
    about.friction_slope.assign(s.n_points, -0.05);
    const std::vector<StabilityRoot> viscous =
                                         stability_roots(pair, linearised_contact(pair, upwind(), about, {})),
                                     lossless = hysteretic_roots(pair, diagonal_loss(pair, 0, 0), upwind(),
                                                                 about, {});
    ASSERT_EQ(viscous.size(), lossless.size());
    for (unsigned int k = 0; k < viscous.size(); ++k)
    {
      EXPECT_LT(std::abs(value_of(viscous[k]) - value_of(lossless[k])),
                1e-8 * std::abs(value_of(viscous[k])));
      EXPECT_EQ(viscous[k].label, lossless[k].label);
    }
  }
}

TEST(HystereticLoss, RootsMakeTheContactsEquationsSingularAndAreAllCounted)
{
  const Structure s = structure(90, 4);
  const ContactPair pair = undamped(reduce(s, 30, 0));
  int most = 0, n_spurious = 0;
  double farthest = 0, worst = 0;
  for (const bool force_given : {false, true})
    for (const double mu : {0., 0.3, 0.6})
      for (const double size : {1e-3, 2e-2})
      {
        RollingEquilibrium about = sliding(s.n_points, mu, 100, 0.5);
        about.force_given = force_given;
        about.speed = 0.02;
        const HystereticLoss loss = coupled_loss(pair, size);
        const std::vector<StabilityRoot> roots = hysteretic_roots(pair, loss, upwind(), about, {});
        const ContactReceptance F(pair, upwind(), about, &loss);
        for (const StabilityRoot &root : roots)
          if (root.frequency > 0)
          {
            const ContactRoot found = contact_root(F, value_of(root));
            worst = std::max(worst, found.residual);
            farthest = std::max(farthest, std::abs(found.s - value_of(root)) / std::abs(found.s));
          }
        const RootCount count = count_unstable_roots(pair, upwind(), about, roots, &loss);
        EXPECT_EQ(count.unstable, int(unstable(roots).size())) << "friction " << mu << ", loss " << size;
        EXPECT_LT(std::abs(count.remainder), 1e-2);
        most = std::max(most, count.unstable);
        for (const Complex &root :
             complex_eigenvectors(linearised_contact(pair, loss, upwind(), about, {}), "roots").values)
          n_spurious += root.real() > 0 && root.imag() < 0;
      }
  EXPECT_LT(worst, 1e-12);
  EXPECT_LT(farthest, 1e-8);
  EXPECT_GT(most, 0);
  EXPECT_GT(n_spurious, 100);
}

TEST(HystereticLoss, NewtonFindsARootFromBesideIt)
{
  const Structure s = structure(90, 4);
  const ContactPair pair = undamped(reduce(s, 30, 0));
  const RollingEquilibrium about = sliding(s.n_points, 0.4, 100, 0.5);
  const HystereticLoss loss = coupled_loss(pair, 2e-2);
  const Complex root = value_of(hysteretic_roots(pair, loss, upwind(), about, {}).front());
  // one body by a function of s alone, without a derivative
  ContactPair nothing = pair;
  nothing.omega.clear();
  nothing.damping_ratio.clear();
  nothing.body.clear();
  nothing.trace.reinit(pair.trace.m(), 0);
  PatchReceptance body = modal_receptance(pair, 1, &loss);
  body.derivative = {};
  HystereticLoss rest = loss;
  rest.modal = DenseMatrix();
  const ContactReceptance by_modes(pair, upwind(), about, &loss),
      by_function(nothing, upwind(), about, &rest, {body});
  EXPECT_LT(difference(by_modes.value(root * 1.1), by_function.value(root * 1.1)), 1e-12);
  EXPECT_LT(difference(by_modes.derivative(root * 1.1), by_function.derivative(root * 1.1)), 1e-6);
  std::vector<Complex> x = contact_root(by_modes, root).x;
  for (const ContactReceptance *const F : {&by_modes, &by_function})
  {
    const ContactRoot found = contact_root(*F, root * Complex(1.0005, 0.0005), x);
    EXPECT_LT(std::abs(found.s - root), 1e-8 * std::abs(root));
    EXPECT_LE(found.iterations, 12u);
  }
}

TEST(HystereticLoss, ModesWithoutAnyLossCannotBeCounted)
{
  const Structure s = structure(90, 4);
  const ContactPair pair = undamped(reduce(s, 30, 0));
  const HystereticLoss loss = diagonal_loss(pair, 0, 0);
  EXPECT_THROW(count_unstable_roots(pair, upwind(), sliding(s.n_points, 0.4, 100, 0.5), {}, &loss),
               InputError);
}

TEST(HystereticLoss, OnASuspendedHubIsThatOfTheBodyInItsOwnCoordinates)
{
  ContactPair pair = held_bar(4, 0.1);
  const HystereticLoss held = coupled_loss(pair, 0.05);
  SuspensionParameters suspension;
  suspension.mass = 2;
  std::fill_n(suspension.stiffness, 3, 3.);
  HystereticLoss loss = held;
  const ContactPair moving = suspended_pair(pair, suspended_hub(suspension), {}, &loss);
  RollingEquilibrium open = sliding(1, 0., 0, 1);
  open.contact.status = {ContactStatus::open};
  const std::vector<StabilityRoot> roots = hysteretic_roots(moving, loss, upwind(), open, {});
  ASSERT_EQ(roots.size(), 7u);
  // (s^2 [1, Gamma; Gamma^T, m] + [w^2 + j H, 0; 0, k]) x = 0
  for (const StabilityRoot &root : roots)
  {
    const Complex s = value_of(root);
    ComplexMatrix Z(7, 7);
    for (unsigned int a = 0; a < 4; ++a)
    {
      Z(a, a) = s * s + pair.omega[a] * pair.omega[a];
      for (unsigned int b = 0; b < 4; ++b)
        Z(a, b) += j * held.modal(a, b);
      for (unsigned int d = 0; d < 3; ++d)
        Z(a, 4 + d) = Z(4 + d, a) = s * s * pair.participation(a, d);
    }
    for (unsigned int d = 0; d < 3; ++d)
      Z(4 + d, 4 + d) = s * s * suspension.mass + suspension.stiffness[d];
    const std::vector<double> values = complex_singular_values(Z).values;
    EXPECT_LT(values[6] / values[0], 1e-12) << root.frequency;
  }
}

TEST(HystereticLossMpi, ARailOnLossyPadsNeedsItsLossInFull)
{
  // pads have a loss factor of 1, the rail of 0.02
  BeamRailParameters rail;
  rail.length = 4.8;
  ElasticMaterial steel;
  steel.young_modulus = 205e9;
  steel.poisson_ratio = 0.3;
  steel.loss_factor = 0.02;
  ContactGrid grid;
  grid.n_x = grid.n_y = 1;
  grid.spacing_x = grid.spacing_y = 1e-3;
  const auto system = assemble_beam_rail(rail, steel, "rail", &grid, MPI_COMM_WORLD);
  Flexibility flexibility(*system);
  ModeParameters parameters;
  parameters.upper_frequency = 12000;
  const ModalReduction modal = reduce_modally(*system, flexibility, parameters, {});
  const ReducedBody body = combine(reduce_statically(*system, flexibility), &modal);
  ASSERT_EQ(body.loss.m(), body.n_modes());
  ContactPair pair;
  pair.interface.contacts.only() = grid;
  static_cast<BodyInContact &>(pair) = body;
  pair.body.assign(pair.n_modes(), 1);
  HystereticLoss full = diagonal_loss(pair, 0, 0.02), diagonal = full;
  full.modal = body.loss;
  for (unsigned int k = 0; k < pair.n_modes(); ++k)
  {
    diagonal.modal(k, k) = body.loss(k, k);
    EXPECT_NEAR(body.loss(k, k), 2 * pair.damping_ratio[k] * std::pow(pair.omega[k], 2),
                1e-9 * body.loss(k, k));
  }
  pair.damping_ratio.assign(pair.n_modes(), 0.);
  HarmonicSolver solver(*system);
  double worst_full = 0, worst_diagonal = 0;
  for (const double f : {100., 334., 918., 1058., 1670.})
  {
    const std::vector<Complex> truth = solver.receptance(2 * M_PI * f, system->trace.rows);
    for (const HystereticLoss *const loss : {&full, &diagonal})
    {
      const PatchReceptance modes = modal_receptance(pair, 1, loss);
      const ComplexMatrix G = modes.value(Complex(0, 2 * M_PI * f));
      // along the normal and across the rail
      for (const unsigned int row : {0, 2})
      {
        Complex u = loss->residual(row, row);
        for (unsigned int a = 0; a < G.m(); ++a)
          for (unsigned int b = 0; b < G.m(); ++b)
            u += modes.basis(row, a) * G(a, b) * modes.basis(row, b);
        const double error = std::abs(u - truth[4 * row]) / std::abs(truth[4 * row]);
        double &worst = loss == &full ? worst_full : worst_diagonal;
        worst = std::max(worst, error);
      }
    }
  }
  EXPECT_LT(worst_full, 1e-2);
  EXPECT_GT(worst_diagonal, 10 * worst_full);
  std::cout << "receptance of the rail against its elements: " << worst_full << " with H in full, "
            << worst_diagonal << " with its diagonal\n";
}
